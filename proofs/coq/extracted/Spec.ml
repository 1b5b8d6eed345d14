(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Spec.v by build.sh --renew: not to be edited. *)

type vec = { vx : Zint.t; vy : Zint.t; vz : Zint.t }

type traj = (Zint.t * vec) list

type scene = { tbeg : Zint.t; tend : Zint.t; path : (Zint.t -> traj);
               same : (Zint.t -> Zint.t); ncell : Zint.t;
               cell : (Zint.t -> Zint.t list); label : (Zint.t -> Zint.t);
               excluded : (Zint.t * Zint.t) list; eta : Zint.t; ring : 
               Zint.t }
