(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Hit.v by build.sh --renew: not to be edited. *)
open Checker
open Spec

type witness = { wc : Zint.t; wd : Zint.t; wi : Zint.t; wj : Zint.t;
                 wp : (Zint.t * Zint.t) list; wq : (Zint.t * Zint.t) list }

val value_at : vec -> Zint.t -> Zint.t -> traj -> rat option

val rat_add : rat -> rat -> rat

val total : (Zint.t * Zint.t) list -> Zint.t

val moment :
  scene -> vec -> Zint.t -> Zint.t -> (Zint.t * Zint.t) list -> rat option

val square_in : scene -> witness -> vec -> rat option

val near : scene -> witness -> bool

val member : Zint.t -> Zint.t list -> bool

val side_ok : scene -> Zint.t -> (Zint.t * Zint.t) list -> bool

val check_hit : bool -> scene -> witness -> bool
