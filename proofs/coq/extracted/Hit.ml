(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Hit.v by build.sh --renew: not to be edited. *)
open Checker
open Spec

type witness = { wc : Zint.t; wd : Zint.t; wi : Zint.t; wj : Zint.t;
                 wp : (Zint.t * Zint.t) list; wq : (Zint.t * Zint.t) list }

(** val value_at : vec -> Zint.t -> Zint.t -> traj -> rat option **)

let value_at n c d tr =
  match since d c (index tr) with
  | [] -> None
  | p :: r ->
    let (t0, p0) = p in
    (match r with
     | [] ->
       if Zint.equal c (Zint.mul t0 d)
       then Some ((dot n p0), Zint.one)
       else None
     | p1 :: _ ->
       let (t1, p2) = p1 in
       if Zint.leq c (Zint.mul t1 d)
       then Some
              (between (Zint.mul t0 d) (dot n p0) (Zint.mul t1 d) (dot n p2)
                c)
       else None)

(** val rat_add : rat -> rat -> rat **)

let rat_add q r =
  if Zint.equal (snd q) (snd r)
  then ((Zint.add (fst q) (fst r)), (snd q))
  else ((Zint.add (Zint.mul (fst q) (snd r)) (Zint.mul (fst r) (snd q))),
         (Zint.mul (snd q) (snd r)))

(** val total : (Zint.t * Zint.t) list -> Zint.t **)

let rec total = function
| [] -> Zint.zero
| x :: r -> Zint.add (snd x) (total r)

(** val moment :
    scene -> vec -> Zint.t -> Zint.t -> (Zint.t * Zint.t) list -> rat option **)

let rec moment s n c d = function
| [] -> Some (Zint.zero, Zint.one)
| x :: r ->
  (match value_at n c d (s.path (fst x)) with
   | Some q ->
     (match moment s n c d r with
      | Some m -> Some (rat_add ((Zint.mul (snd x) (fst q)), (snd q)) m)
      | None -> None)
   | None -> None)

(** val square_in : scene -> witness -> vec -> rat option **)

let square_in s w n =
  match moment s n w.wc w.wd w.wp with
  | Some p ->
    (match moment s n w.wc w.wd w.wq with
     | Some q ->
       let g =
         Zint.sub (Zint.mul (Zint.mul (fst p) (total w.wq)) (snd q))
           (Zint.mul (Zint.mul (fst q) (total w.wp)) (snd p))
       in
       let h =
         Zint.mul (Zint.mul (snd p) (total w.wp))
           (Zint.mul (snd q) (total w.wq))
       in
       Some ((Zint.mul g g), (Zint.mul h h))
     | None -> None)
  | None -> None

(** val near : scene -> witness -> bool **)

let near s w =
  match square_in s w { vx = Zint.one; vy = Zint.zero; vz = Zint.zero } with
  | Some x ->
    (match square_in s w { vx = Zint.zero; vy = Zint.one; vz = Zint.zero } with
     | Some y ->
       (match square_in s w { vx = Zint.zero; vy = Zint.zero; vz = Zint.one } with
        | Some z ->
          let q = rat_add x (rat_add y z) in
          Zint.leq (fst q) (Zint.mul (Zint.mul s.eta s.eta) (snd q))
        | None -> false)
     | None -> false)
  | None -> false

(** val member : Zint.t -> Zint.t list -> bool **)

let member v l =
  List.exists (fun u -> Zint.equal v u) l

(** val side_ok : scene -> Zint.t -> (Zint.t * Zint.t) list -> bool **)

let side_ok s i l =
  (&&)
    ((&&) ((&&) (Zint.leq Zint.zero i) (Zint.lt i s.ncell))
      (Zint.lt Zint.zero (total l)))
    (List.for_all (fun x ->
      (&&) ((&&) (Zint.leq Zint.zero (snd x)) (member (fst x) (s.cell i)))
        (wf_traj s.tbeg s.tend (s.path (fst x)))) l)

(** val check_hit : bool -> scene -> witness -> bool **)

let check_hit strict s w =
  (&&)
    ((&&)
      ((&&)
        ((&&)
          ((&&)
            ((&&)
              ((&&)
                ((&&)
                  ((&&)
                    ((&&) (Zint.lt s.tbeg s.tend) (Zint.lt Zint.zero w.wd))
                    (Zint.leq (Zint.mul s.tbeg w.wd) w.wc))
                  (Zint.leq w.wc (Zint.mul s.tend w.wd)))
                ((||) strict (not (Zint.equal w.wi w.wj))))
              (side_ok s w.wi w.wp)) (side_ok s w.wj w.wq))
          (not (excluded_pair s (s.label w.wi) (s.label w.wj))))
        (List.for_all (fun x ->
          List.for_all (fun y ->
            not (Zint.equal (s.same (fst x)) (s.same (fst y)))) w.wq) w.wp))
      (Zint.equal s.ring Zint.one)) (near s w)
