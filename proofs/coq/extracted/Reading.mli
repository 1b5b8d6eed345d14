(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Reading.v by build.sh --renew: not to be edited. *)
open Checker
open Spec

type spot = { xm : Zint.t; xe : Zint.t; ym : Zint.t; ye : Zint.t;
              zm : Zint.t; ze : Zint.t }

val place : spot -> vec

type reading = { first_time : Zint.t; first_spot : spot;
                 later : (Zint.t * spot) list Lazy.t }

val places : (Zint.t * spot) list -> traj -> traj

val traj_of : reading -> traj

val coarse_part : Zint.t -> Zint.t -> Zint.t -> Zint.t

val coarse_spot : Zint.t -> spot -> vec

val wf_read : (Zint.t -> reading) -> scene -> Zint.t -> bool

val line_read : scene -> Zint.t -> reading -> band option

val vertex_read : (Zint.t -> reading) -> scene -> Zint.t -> Zint.t -> vertex

val start_read :
  (Zint.t -> reading) -> scene -> group -> obligation list option
