(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Hit.v by build.sh --renew: not to be edited. *)
open Checker
open Poly
open Spec

type witness = { wi : Zint.t; wj : Zint.t; wp : (Zint.t * poly) list;
                 wq : (Zint.t * poly) list; wg : poly; wl : Zint.t;
                 wu : Zint.t; wd : Zint.t }

type segment = { time0 : Zint.t; place0 : vec; time1 : Zint.t; place1 : vec }

(** val segment_of : Zint.t -> Zint.t -> Zint.t -> traj -> segment option **)

let segment_of l u d tr =
  match since d l (index tr) with
  | [] -> None
  | p :: r ->
    let (t0, p0) = p in
    (match r with
     | [] ->
       if Zint.leq u (Zint.mul t0 d)
       then Some { time0 = t0; place0 = p0; time1 = (Zint.add t0 Zint.one);
              place1 = p0 }
       else None
     | p1 :: _ ->
       let (t1, p2) = p1 in
       if Zint.leq u (Zint.mul t1 d)
       then Some { time0 = t0; place0 = p0; time1 = t1; place1 = p2 }
       else None)

type side = (poly * segment) list

(** val side_of :
    scene -> Zint.t -> Zint.t -> Zint.t -> (Zint.t * poly) list -> side option **)

let rec side_of s l u d = function
| [] -> Some []
| p :: r ->
  let (v, a) = p in
  (match segment_of l u d (s.path v) with
   | Some p0 ->
     (match side_of s l u d r with
      | Some q -> Some ((a, p0) :: q)
      | None -> None)
   | None -> None)

(** val line : vec -> segment -> poly **)

let line n p =
  let g0 = dot n p.place0 in
  let g1 = dot n p.place1 in
  (Zint.sub (Zint.mul g0 p.time1) (Zint.mul g1 p.time0)) :: ((Zint.sub g1 g0) :: [])

(** val duration : segment -> Zint.t **)

let duration p =
  Zint.sub p.time1 p.time0

(** val durations : side -> Zint.t **)

let rec durations = function
| [] -> Zint.one
| p0 :: r -> let (_, p) = p0 in Zint.mul (duration p) (durations r)

(** val total : side -> poly **)

let rec total = function
| [] -> []
| p :: r -> let (a, _) = p in add a (total r)

(** val moment : vec -> side -> poly **)

let rec moment n = function
| [] -> []
| p0 :: r ->
  let (a, p) = p0 in
  add (scale (durations r) (mul a (line n p)))
    (scale (duration p) (moment n r))

(** val difference : vec -> side -> side -> poly **)

let difference n p q =
  sub (scale (durations q) (mul (moment n p) (total q)))
    (scale (durations p) (mul (moment n q) (total p)))

(** val meet : poly -> side -> side -> bool **)

let meet g p q =
  (&&)
    ((&&)
      (divides g
        (difference { vx = Zint.one; vy = Zint.zero; vz = Zint.zero } p q))
      (divides g
        (difference { vx = Zint.zero; vy = Zint.one; vz = Zint.zero } p q)))
    (divides g
      (difference { vx = Zint.zero; vy = Zint.zero; vz = Zint.one } p q))

(** val nearness : Zint.t -> side -> side -> poly **)

let nearness e p q =
  let square = fun a -> mul a a in
  sub
    (square
      (scale (Zint.mul (Zint.mul e (durations p)) (durations q))
        (mul (total p) (total q))))
    (add
      (square
        (difference { vx = Zint.one; vy = Zint.zero; vz = Zint.zero } p q))
      (add
        (square
          (difference { vx = Zint.zero; vy = Zint.one; vz = Zint.zero } p q))
        (square
          (difference { vx = Zint.zero; vy = Zint.zero; vz = Zint.one } p q))))

(** val nonnegative_at :
    Zint.t -> Zint.t -> Zint.t -> poly -> poly -> bool **)

let nonnegative_at l u d g p =
  (||) (divides g p) (nonnegative_on l u d p)

(** val member : Zint.t -> Zint.t list -> bool **)

let member v l =
  List.exists (fun u -> Zint.equal u v) l

(** val side_ok :
    scene -> Zint.t -> Zint.t -> Zint.t -> poly -> Zint.t -> (Zint.t * poly)
    list -> bool **)

let side_ok s l u d g i vs =
  (&&) ((&&) (Zint.leq Zint.zero i) (Zint.lt i s.ncell))
    (List.for_all (fun x ->
      (&&)
        ((&&) (member (fst x) (s.cell i))
          (wf_traj s.tbeg s.tend (s.path (fst x))))
        (nonnegative_at l u d g (snd x))) vs)

(** val grown : scene -> Zint.t list -> Zint.t list **)

let grown s l =
  snd
    (Zint.repeatedly s.ncell (fun x ->
      let i = fst x in
      ((Zint.add i Zint.one),
      (if List.exists (fun v -> member (s.same v) l) (s.cell i)
       then union (fun v -> v) (cell_ids s.same s i) (snd x)
       else snd x))) (Zint.zero, l))

(** val merged : scene -> (Zint.t * poly) list -> Zint.t list **)

let merged s vs =
  List.map (fun x -> s.same (fst x)) vs

(** val disjoint : Zint.t list -> Zint.t list -> bool **)

let disjoint p q =
  List.for_all (fun v -> not (member v p)) q

(** val far_apart : scene -> Zint.t list -> Zint.t list -> bool **)

let far_apart s p q =
  disjoint (Zint.repeatedly (Zint.sub s.ring Zint.one) (grown s) p) q

(** val check_hit : bool -> scene -> witness -> bool **)

let check_hit strict s w =
  let l = w.wl in
  let u = w.wu in
  let d = w.wd in
  let g = w.wg in
  (&&)
    ((&&)
      ((&&)
        ((&&)
          ((&&)
            ((&&)
              ((&&)
                ((&&)
                  ((&&)
                    ((&&)
                      ((&&) (Zint.lt s.tbeg s.tend) (Zint.lt Zint.zero d))
                      (Zint.leq (Zint.mul s.tbeg d) l)) (Zint.leq l u))
                  (Zint.leq u (Zint.mul s.tend d))) (changes_sign l u d g))
              (side_ok s l u d g w.wi w.wp)) (side_ok s l u d g w.wj w.wq))
          ((||) strict (not (Zint.equal w.wi w.wj))))
        (not (excluded_pair s (s.label w.wi) (s.label w.wj))))
      (disjoint (merged s w.wp) (merged s w.wq)))
    (match side_of s l u d w.wp with
     | Some p ->
       (match side_of s l u d w.wq with
        | Some q ->
          (&&)
            ((&&) (positive_on l u d (total p)) (positive_on l u d (total q)))
            ((||) (meet g p q)
              ((&&)
                ((&&) (Zint.lt Zint.zero s.eta)
                  (far_apart s (merged s w.wp) (merged s w.wq)))
                (nonnegative_at l u d g (nearness s.eta p q))))
        | None -> false)
     | None -> false)
