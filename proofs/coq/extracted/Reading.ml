(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Reading.v by build.sh --renew: not to be edited. *)
open Checker
open Spec

type spot = { xm : Zint.t; xe : Zint.t; ym : Zint.t; ye : Zint.t;
              zm : Zint.t; ze : Zint.t }

(** val place : spot -> vec **)

let place p =
  { vx = (Zint.shiftl p.xm p.xe); vy = (Zint.shiftl p.ym p.ye); vz =
    (Zint.shiftl p.zm p.ze) }

type reading = { first_time : Zint.t; first_spot : spot;
                 later : (Zint.t * spot) list Lazy.t }

(** val places : (Zint.t * spot) list -> traj -> traj **)

let rec places l acc =
  match l with
  | [] -> List.rev_append acc []
  | p0 :: r -> let (t, p) = p0 in places r ((t, (place p)) :: acc)

(** val traj_of : reading -> traj **)

let traj_of r =
  (r.first_time, (place r.first_spot)) :: (places (Lazy.force r.later) [])

(** val coarse_part : Zint.t -> Zint.t -> Zint.t -> Zint.t **)

let coarse_part s m e =
  if Zint.lt e s
  then Zint.shiftr m (Zint.sub s e)
  else Zint.shiftl m (Zint.sub e s)

(** val coarse_spot : Zint.t -> spot -> vec **)

let coarse_spot s p =
  { vx = (coarse_part s p.xm p.xe); vy = (coarse_part s p.ym p.ye); vz =
    (coarse_part s p.zm p.ze) }

(** val wf_read : (Zint.t -> reading) -> scene -> Zint.t -> bool **)

let wf_read read s v =
  let r = read v in
  (&&)
    ((&&) (Zint.leq r.first_time s.tbeg)
      (reaches r.first_time s.tend (Lazy.force r.later)))
    ((||) (Zint.equal (s.same v) v)
      (equal_traj (traj_of (read (s.same v))) (traj_of r)))

(** val line_read : scene -> Zint.t -> reading -> band option **)

let line_read s e r =
  match chord_by (coarse_spot e) e s.tbeg s.tend ((r.first_time,
          r.first_spot) :: (Lazy.force r.later)) with
  | Some c -> band_of c
  | None -> None

(** val vertex_read :
    (Zint.t -> reading) -> scene -> Zint.t -> Zint.t -> vertex **)

let vertex_read read s e v =
  { vid = v; delayed_trail = (Lazy.from_fun (fun _ ->
    index (traj_of (read v)))); line = (line_read s e (read v)) }

(** val start_read :
    (Zint.t -> reading) -> scene -> group -> obligation list option **)

let start_read read s =
  let first = fun v ->
    let r = read v in (r.first_time, (place r.first_spot)) :: []
  in
  start_by
    (build_by (wf_read read s) (unit_bits first) (vertex_read read s) s) s
