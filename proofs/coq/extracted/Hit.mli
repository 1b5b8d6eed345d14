(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Hit.v by build.sh --renew: not to be edited. *)
open Checker
open Poly
open Spec

type witness = { wi : Zint.t; wj : Zint.t; wp : (Zint.t * poly) list;
                 wq : (Zint.t * poly) list; wg : poly; wl : Zint.t;
                 wu : Zint.t; wd : Zint.t }

type segment = { time0 : Zint.t; place0 : vec; time1 : Zint.t; place1 : vec }

val segment_of : Zint.t -> Zint.t -> Zint.t -> traj -> segment option

type side = (poly * segment) list

val side_of :
  scene -> Zint.t -> Zint.t -> Zint.t -> (Zint.t * poly) list -> side option

val line : vec -> segment -> poly

val duration : segment -> Zint.t

val durations : side -> Zint.t

val total : side -> poly

val moment : vec -> side -> poly

val difference : vec -> side -> side -> poly

val meet : poly -> side -> side -> bool

val nearness : Zint.t -> side -> side -> poly

val nonnegative_at : Zint.t -> Zint.t -> Zint.t -> poly -> poly -> bool

val member : Zint.t -> Zint.t list -> bool

val side_ok :
  scene -> Zint.t -> Zint.t -> Zint.t -> poly -> Zint.t -> (Zint.t * poly)
  list -> bool

val grown : scene -> Zint.t list -> Zint.t list

val merged : scene -> (Zint.t * poly) list -> Zint.t list

val disjoint : Zint.t list -> Zint.t list -> bool

val far_apart : scene -> Zint.t list -> Zint.t list -> bool

val check_hit : bool -> scene -> witness -> bool
