(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Checker.v by build.sh --renew: not to be edited. *)
open Spec

type group =
| Cell of Zint.t
| Join of group * group

type halfspace = { normal : vec; nt : Zint.t; nd : Zint.t }

type way = (Zint.t * Zint.t) list

type token =
| THalve
| TLeft
| TRight
| TDrop of Zint.t
| TRing of Zint.t * way list
| TFar
| TPlane of halfspace * Zint.t
| TDirection of vec
| TExcluded
| TParts
| TOne
| TBoth

(** val reaches : Zint.t -> Zint.t -> (Zint.t * 'a1) list -> bool **)

let rec reaches t0 t = function
| [] -> Zint.leq t t0
| p :: r' -> let (t1, _) = p in (&&) (Zint.lt t0 t1) (reaches t1 t r')

(** val wf_traj : Zint.t -> Zint.t -> traj -> bool **)

let wf_traj t0 t1 = function
| [] -> false
| p :: r -> let (t2, _) = p in (&&) (Zint.leq t2 t0) (reaches t2 t1 r)

(** val equal_traj : traj -> traj -> bool **)

let rec equal_traj tr1 tr2 =
  match tr1 with
  | [] -> (match tr2 with
           | [] -> true
           | _ :: _ -> false)
  | p :: r1 ->
    let (t1, p1) = p in
    (match tr2 with
     | [] -> false
     | p0 :: r2 ->
       let (t2, p2) = p0 in
       if (&&)
            ((&&) ((&&) (Zint.equal t1 t2) (Zint.equal p1.vx p2.vx))
              (Zint.equal p1.vy p2.vy)) (Zint.equal p1.vz p2.vz)
       then equal_traj r1 r2
       else false)

type 'a search =
| Found of 'a
| Choose of Zint.t * 'a search * 'a search

(** val find : (Zint.t -> bool) -> 'a1 search -> 'a1 **)

let rec find low = function
| Found x0 -> x0
| Choose (k, l, r) -> if low k then find low r else find low l

(** val join_pairs :
    (Zint.t * 'a1 search) list -> (Zint.t * 'a1 search) list -> (Zint.t * 'a1
    search) list **)

let rec join_pairs l acc =
  match l with
  | [] -> List.rev_append acc l
  | p :: l0 ->
    let (k1, x) = p in
    (match l0 with
     | [] -> List.rev_append acc l
     | p0 :: r ->
       let (k2, y) = p0 in join_pairs r ((k1, (Choose (k2, x, y))) :: acc))

(** val join_all :
    'a2 list -> (Zint.t * 'a1 search) list -> 'a1 search option **)

let rec join_all fuel l = match l with
| [] -> None
| p :: r ->
  let (_, x) = p in
  (match r with
   | [] -> Some x
   | _ :: _ ->
     (match fuel with
      | [] -> Some x
      | _ :: f -> join_all f (join_pairs l [])))

(** val suffixes :
    traj -> (Zint.t * traj search) list -> (Zint.t * traj search) list **)

let rec suffixes tr acc =
  match tr with
  | [] -> List.rev_append acc []
  | p :: r -> let (t, _) = p in suffixes r ((t, (Found tr)) :: acc)

(** val index : traj -> traj search **)

let index tr =
  match join_all tr (suffixes tr []) with
  | Some x -> x
  | None -> Found tr

(** val since : Zint.t -> Zint.t -> traj search -> traj **)

let since d a x =
  find (fun t -> Zint.leq (Zint.mul t d) a) x

(** val dot : vec -> vec -> Zint.t **)

let dot n p =
  Zint.add (Zint.add (Zint.mul n.vx p.vx) (Zint.mul n.vy p.vy))
    (Zint.mul n.vz p.vz)

(** val value : halfspace -> Zint.t -> vec -> Zint.t **)

let value h t p =
  Zint.sub (Zint.add (dot h.normal p) (Zint.mul h.nt t)) h.nd

(** val opposite : vec -> vec **)

let opposite n =
  { vx = (Zint.neg n.vx); vy = (Zint.neg n.vy); vz = (Zint.neg n.vz) }

(** val behind : halfspace -> Zint.t -> halfspace **)

let behind h w =
  { normal = (opposite h.normal); nt = (Zint.neg h.nt); nd =
    (Zint.sub w h.nd) }

(** val wide : Zint.t -> vec -> Zint.t -> bool **)

let wide e n w =
  (&&) (Zint.leq Zint.zero w)
    (Zint.leq (Zint.mul (Zint.mul e e) (dot n n)) (Zint.mul w w))

(** val segment_positive :
    Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> bool **)

let segment_positive a b s0 g0 s1 g1 =
  (&&)
    (if Zint.leq a s0
     then Zint.lt Zint.zero g0
     else Zint.lt Zint.zero
            (Zint.add (Zint.mul g0 (Zint.sub s1 a))
              (Zint.mul g1 (Zint.sub a s0))))
    (if Zint.leq s1 b
     then Zint.lt Zint.zero g1
     else Zint.lt Zint.zero
            (Zint.add (Zint.mul g0 (Zint.sub s1 b))
              (Zint.mul g1 (Zint.sub b s0))))

(** val inside_from :
    halfspace -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> traj ->
    bool **)

let rec inside_from h a b d t0 g0 = function
| [] -> false
| p :: r' ->
  let (t1, p1) = p in
  let g1 = value h t1 p1 in
  let s1 = Zint.mul t1 d in
  if segment_positive a b (Zint.mul t0 d) g0 s1 g1
  then if Zint.leq b s1 then true else inside_from h a b d t1 g1 r'
  else false

(** val inside :
    halfspace -> Zint.t -> Zint.t -> Zint.t -> traj search -> bool **)

let inside h a b d x =
  match since d a x with
  | [] -> false
  | p :: r -> let (t0, p0) = p in inside_from h a b d t0 (value h t0 p0) r

(** val lesser : Zint.t -> Zint.t -> Zint.t **)

let lesser a b =
  if Zint.lt b a then b else a

(** val greater : Zint.t -> Zint.t -> Zint.t **)

let greater a b =
  if Zint.lt a b then b else a

(** val by_axis : (Zint.t -> Zint.t -> Zint.t) -> vec -> vec -> vec **)

let by_axis f p q =
  { vx = (f p.vx q.vx); vy = (f p.vy q.vy); vz = (f p.vz q.vz) }

type chord = { grain : Zint.t; origin : vec; motion : vec; lows : vec;
               highs : vec }

(** val unit_bits : (Zint.t -> traj) -> Zint.t list -> Zint.t **)

let unit_bits path ids =
  let most = fun m v ->
    match path v with
    | [] -> m
    | p0 :: _ ->
      let (_, p) = p0 in
      greater m
        (greater (Zint.abs p.vx) (greater (Zint.abs p.vy) (Zint.abs p.vz)))
  in
  greater Zint.zero
    (Zint.sub
      (Zint.log2 ((fun f l a -> List.fold_left f a l) most ids Zint.zero))
      Zint.place_bits)

(** val last_from : Zint.t -> 'a1 -> (Zint.t * 'a1) list -> Zint.t * 'a1 **)

let rec last_from t p = function
| [] -> (t, p)
| p0 :: r' -> let (t1, p1) = p0 in last_from t1 p1 r'

(** val part : Zint.t -> Zint.t -> Zint.t **)

let part t w =
  let t' = Zint.shiftl t Zint.half_bits in
  let q = Zint.fdiv t' w in
  Zint.add (Zint.shiftl q Zint.half_bits)
    (Zint.fdiv (Zint.shiftl (Zint.sub t' (Zint.mul q w)) Zint.half_bits) w)

(** val stray : Zint.t -> Zint.t -> vec -> vec -> Zint.t -> vec -> vec **)

let stray t0 w o w0 t p =
  let u = part (Zint.sub t t0) w in
  let on = fun p0 o0 w1 ->
    Zint.sub p0 (Zint.add o0 (Zint.shiftr (Zint.mul w1 u) Zint.time_bits))
  in
  { vx = (on p.vx o.vx w0.vx); vy = (on p.vy o.vy w0.vy); vz =
  (on p.vz o.vz w0.vz) }

(** val slack : Zint.t -> Zint.t **)

let slack w =
  Zint.add (Zint.add (Zint.shiftr (Zint.abs w) Zint.time_bits) Zint.one)
    Zint.one

(** val strays :
    ('a1 -> vec) -> Zint.t -> Zint.t -> vec -> vec -> (Zint.t * 'a1) list ->
    vec -> vec -> vec * vec **)

let rec strays f t0 w o w0 r l h =
  match r with
  | [] -> (l, h)
  | p0 :: r' ->
    let (t, p) = p0 in
    let e = stray t0 w o w0 t (f p) in
    strays f t0 w o w0 r' (by_axis lesser l e) (by_axis greater h e)

(** val chord_by :
    ('a1 -> vec) -> Zint.t -> Zint.t -> Zint.t -> (Zint.t * 'a1) list ->
    chord option **)

let chord_by f s t0 t1 = function
| [] -> None
| p :: r ->
  let (t2, p0) = p in
  let e = last_from t2 p0 r in
  if (&&) ((&&) (Zint.equal t2 t0) (Zint.equal (fst e) t1)) (Zint.lt t0 t1)
  then let o = f p0 in
       let w = by_axis Zint.sub (f (snd e)) o in
       let lh =
         strays f t0 (Zint.sub t1 t0) o w r { vx = Zint.zero; vy = Zint.zero;
           vz = Zint.zero } { vx = Zint.zero; vy = Zint.zero; vz = Zint.zero }
       in
       Some { grain = (Zint.shiftl Zint.one s); origin = o; motion = w;
       lows = (by_axis (fun l w0 -> Zint.sub l (slack w0)) (fst lh) w);
       highs = (by_axis (fun h w0 -> Zint.add h (slack w0)) (snd lh) w) }
  else None

(** val word_lesser : int -> int -> int **)

let word_lesser a b =
  if Zint.word_lt b a then b else a

(** val short : Zint.t -> vec -> bool **)

let short most p =
  (&&) ((&&) (Zint.leq (Zint.abs p.vx) most) (Zint.leq (Zint.abs p.vy) most))
    (Zint.leq (Zint.abs p.vz) most)

type band = { grid : Zint.t; lx : int; ly : int; lz : int; hx : int;
              hy : int; hz : int; mx : int; my : int; mz : int }

(** val band_of : chord -> band option **)

let band_of c =
  let l = by_axis Zint.add c.origin c.lows in
  let h = by_axis Zint.add c.origin c.highs in
  let m = c.motion in
  if (&&) ((&&) (short Zint.most_place l) (short Zint.most_place h))
       (short Zint.most_place m)
  then Some { grid = c.grain; lx = (Zint.to_word l.vx); ly =
         (Zint.to_word l.vy); lz = (Zint.to_word l.vz); hx =
         (Zint.to_word h.vx); hy = (Zint.to_word h.vy); hz =
         (Zint.to_word h.vz); mx = (Zint.to_word m.vx); my =
         (Zint.to_word m.vy); mz = (Zint.to_word m.vz) }
  else None

type vertex = { vid : Zint.t; delayed_trail : traj search Lazy.t;
                line : band option }

(** val trail : vertex -> traj search **)

let trail v =
  Lazy.force v.delayed_trail

(** val least_on : int -> int -> int -> int **)

let least_on n l h =
  Zint.word_mul n (if Zint.word_lt n 0 then h else l)

(** val least_from :
    int -> int -> int -> int -> int -> vertex list -> int -> int ->
    (int * int) option **)

let rec least_from nx ny nz d j x g0 g1 =
  match x with
  | [] -> Some (g0, g1)
  | v :: r ->
    (match v.line with
     | Some c ->
       let l =
         Zint.word_add
           (Zint.word_add (least_on nx c.lx c.hx) (least_on ny c.ly c.hy))
           (least_on nz c.lz c.hz)
       in
       let m =
         Zint.word_add
           (Zint.word_add (Zint.word_mul nx c.mx) (Zint.word_mul ny c.my))
           (Zint.word_mul nz c.mz)
       in
       let g = Zint.word_add (Zint.word_mul d l) (Zint.word_mul j m) in
       least_from nx ny nz d j r (word_lesser g0 g)
         (word_lesser g1 (Zint.word_add g m))
     | None -> None)

(** val least_of :
    vec -> Zint.t -> Zint.t -> vertex list -> (int * int) option **)

let least_of n d j x =
  least_from (Zint.to_word n.vx) (Zint.to_word n.vy) (Zint.to_word n.vz)
    (Zint.to_word d) (Zint.to_word j) x max_int max_int

(** val grain_of : vertex list -> Zint.t option **)

let grain_of = function
| [] -> None
| v :: _ -> (match v.line with
             | Some c -> Some c.grid
             | None -> None)

(** val apart_by_bounds :
    Zint.t -> Zint.t -> Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex
    list -> vertex list -> bool **)

let apart_by_bounds t0 t1 k n a b d x y =
  if (&&) (Zint.leq d Zint.d_quick) (short Zint.most_direction n)
  then let w = Zint.sub t1 t0 in
       let j = Zint.fdiv (Zint.sub a (Zint.mul t0 d)) w in
       if (&&) ((&&) (Zint.leq Zint.zero j) (Zint.leq j Zint.d_quick))
            (Zint.leq b
              (Zint.add (Zint.mul t0 d) (Zint.mul (Zint.add j Zint.one) w)))
       then (match least_of n d j x with
             | Some g ->
               (match least_of (opposite n) d j y with
                | Some h ->
                  let m =
                    word_lesser (Zint.word_add (fst g) (fst h))
                      (Zint.word_add (snd g) (snd h))
                  in
                  if Zint.word_lt 0 m
                  then if Zint.equal k Zint.zero
                       then true
                       else (match grain_of x with
                             | Some e ->
                               let f = Zint.mul e (Zint.of_int m) in
                               Zint.lt (Zint.mul k (Zint.mul d d))
                                 (Zint.mul f f)
                             | None -> false)
                  else false
                | None -> false)
             | None -> false)
       else false
  else false

type rat = Zint.t * Zint.t

(** val rat_lt : rat -> rat -> bool **)

let rat_lt q r =
  if Zint.equal (snd q) (snd r)
  then Zint.lt (fst q) (fst r)
  else Zint.lt (Zint.mul (fst q) (snd r)) (Zint.mul (fst r) (snd q))

(** val rat_over : Zint.t -> rat -> rat -> bool **)

let rat_over k q r =
  if rat_lt q r
  then if Zint.equal k Zint.zero
       then true
       else let g =
              Zint.sub (Zint.mul (fst r) (snd q)) (Zint.mul (fst q) (snd r))
            in
            let h = Zint.mul (snd q) (snd r) in
            Zint.lt (Zint.mul k (Zint.mul h h)) (Zint.mul g g)
  else false

(** val rat_min : rat -> rat -> rat **)

let rat_min q r =
  if rat_lt q r then q else r

(** val between : Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> rat **)

let between s0 g0 s1 g1 c =
  if Zint.equal c s0
  then (g0, Zint.one)
  else if Zint.equal c s1
       then (g1, Zint.one)
       else ((Zint.add (Zint.mul g0 (Zint.sub s1 c))
               (Zint.mul g1 (Zint.sub c s0))), (Zint.sub s1 s0))

(** val along :
    vec -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> traj -> Zint.t -> Zint.t
    list -> rat list -> rat list option **)

let rec along n b d t0 g0 = function
| [] -> (fun _ _ _ -> None)
| p :: r' ->
  let (t1, p1) = p in
  let s0 = Zint.mul t0 d in
  let s1 = Zint.mul t1 d in
  let g1 = dot n p1 in
  let rec here c' cs acc =
    match cs with
    | [] -> if Zint.leq b c' then Some (List.rev_append acc []) else None
    | c :: cs' ->
      if Zint.lt c c'
      then None
      else if Zint.leq c s1
           then here c cs' ((between s0 g0 s1 g1 c) :: acc)
           else if Zint.leq s1 c'
                then along n b d t1 g1 r' c' cs acc
                else None
  in here

(** val values :
    vec -> Zint.t -> Zint.t -> Zint.t -> Zint.t list -> traj search -> rat
    list option **)

let values n a b d cs x =
  match since d a x with
  | [] -> None
  | p :: r ->
    let (t0, p0) = p in
    if Zint.leq (Zint.mul t0 d) a
    then along n b d t0 (dot n p0) r a cs []
    else None

(** val times_until :
    Zint.t -> Zint.t -> Zint.t -> traj -> Zint.t list -> Zint.t list **)

let rec times_until d a b tr acc =
  match tr with
  | [] -> List.rev_append acc []
  | p :: r ->
    let (t, _) = p in
    let c = Zint.mul t d in
    if Zint.lt c b
    then times_until d a b r (if Zint.lt a c then c :: acc else acc)
    else List.rev_append acc []

(** val times : Zint.t -> Zint.t -> Zint.t -> traj search -> Zint.t list **)

let times d a b x =
  times_until d a b (since d a x) []

(** val union_acc :
    ('a1 -> Zint.t) -> 'a1 list -> 'a1 list -> 'a1 list -> 'a1 list **)

let rec union_acc key l1 = match l1 with
| [] -> (fun l2 acc -> List.rev_append acc l2)
| x :: r1 ->
  let rec aux l2 acc =
    match l2 with
    | [] -> List.rev_append acc l1
    | y :: r2 ->
      if Zint.lt (key x) (key y)
      then union_acc key r1 l2 (x :: acc)
      else if Zint.lt (key y) (key x)
           then aux r2 (y :: acc)
           else union_acc key r1 r2 (x :: acc)
  in aux

(** val union : ('a1 -> Zint.t) -> 'a1 list -> 'a1 list -> 'a1 list **)

let union key l1 l2 =
  union_acc key l1 l2 []

(** val lower_acc : rat list -> rat list -> rat list -> rat list **)

let rec lower_acc l1 l2 acc =
  match l1 with
  | [] -> List.rev_append acc []
  | q :: r1 ->
    (match l2 with
     | [] -> List.rev_append acc []
     | r :: r2 -> lower_acc r1 r2 ((rat_min q r) :: acc))

(** val lower : rat list option -> rat list option -> rat list option **)

let lower o v =
  match o with
  | Some l1 ->
    (match v with
     | Some l2 -> Some (lower_acc l1 l2 [])
     | None -> None)
  | None -> None

(** val all_less : Zint.t -> rat list -> rat list -> bool **)

let rec all_less k l1 l2 =
  match l1 with
  | [] -> (match l2 with
           | [] -> true
           | _ :: _ -> false)
  | q :: r1 ->
    (match l2 with
     | [] -> false
     | r :: r2 -> if rat_over k q r then all_less k r1 r2 else false)

(** val apart_by_walk :
    Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex list -> vertex list
    -> bool **)

let apart_by_walk k n a b d x y =
  match x with
  | [] -> true
  | w :: ws ->
    let add = fun cs v -> union (fun c -> c) (times d a b (trail v)) cs in
    let cs =
      (fun f l a -> List.fold_left f a l) add y
        ((fun f l a -> List.fold_left f a l) add x (a :: (b :: [])))
    in
    let at_times = fun v -> values n a b d cs (trail v) in
    (match cs with
     | [] -> false
     | c :: _ ->
       if Zint.equal c a
       then (match (fun f l a -> List.fold_left f a l) (fun l v ->
                     lower l (at_times v)) ws (at_times w) with
             | Some low ->
               List.for_all (fun v ->
                 match at_times v with
                 | Some l -> all_less k l low
                 | None -> false) y
             | None -> false)
       else false)

(** val apart_by_plane :
    Zint.t -> halfspace -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> vertex
    list -> vertex list -> bool **)

let apart_by_plane e h w a b d x y =
  if wide e h.normal w
  then if List.for_all (fun v -> inside h a b d (trail v)) x
       then let h' = behind h w in
            List.for_all (fun v -> inside h' a b d (trail v)) y
       else false
  else false

(** val floor_at : vec -> Zint.t -> Zint.t -> traj search -> Zint.t **)

let floor_at n d c x =
  match since d c x with
  | [] -> Zint.zero
  | p :: l ->
    let (t0, p0) = p in
    (match l with
     | [] -> dot n p0
     | p2 :: _ ->
       let (t1, p1) = p2 in
       let q = between (Zint.mul t0 d) (dot n p0) (Zint.mul t1 d) (dot n p1) c
       in
       Zint.fdiv (fst q) (snd q))

(** val least_at : vec -> Zint.t -> Zint.t -> vertex list -> Zint.t **)

let least_at n d c = function
| [] -> Zint.zero
| v :: r ->
  (fun f l a -> List.fold_left f a l) (fun m v0 ->
    lesser m (floor_at n d c (trail v0))) r (floor_at n d c (trail v))

(** val plane_between :
    Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex list -> vertex list
    -> halfspace * Zint.t **)

let plane_between k n a b d x y =
  let n0 = by_axis Zint.add n n in
  let w =
    if Zint.equal k Zint.zero
    then Zint.zero
    else Zint.add (Zint.sqrt (Zint.shiftl k (Zint.add Zint.one Zint.one)))
           Zint.one
  in
  let middle = fun c ->
    Zint.shiftr
      (Zint.add (Zint.sub (least_at n0 d c x) (least_at (opposite n0) d c y))
        w) Zint.one
  in
  let f = middle a in
  let g = Zint.sub (middle b) f in
  let l = Zint.sub b a in
  ({ normal = { vx = (Zint.mul l n0.vx); vy = (Zint.mul l n0.vy); vz =
  (Zint.mul l n0.vz) }; nt = (Zint.neg (Zint.mul g d)); nd =
  (Zint.sub (Zint.mul f l) (Zint.mul g a)) }, (Zint.mul w l))

(** val empty : vertex list -> bool **)

let empty = function
| [] -> true
| _ :: _ -> false

(** val separated :
    Zint.t -> Zint.t -> Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex
    list -> vertex list -> bool **)

let separated t0 t1 e n a b d x y =
  let k = Zint.mul (Zint.mul e e) (dot n n) in
  if (||) (empty x) (empty y)
  then true
  else if apart_by_bounds t0 t1 k n a b d x y
       then true
       else let hw = plane_between k n a b d x y in
            if apart_by_plane e (fst hw) (snd hw) a b d x y
            then true
            else apart_by_walk k n a b d x y

type tree =
| Leaf of Zint.t * vertex list
| Node of Zint.t option * vertex list * tree * tree

(** val at_most : Zint.t -> 'a1 list -> bool **)

let rec at_most k = function
| [] -> true
| _ :: r -> (&&) (Zint.lt Zint.zero k) (at_most (Zint.sub k Zint.one) r)

(** val own : tree -> vertex list **)

let own = function
| Leaf (_, vs) -> vs
| Node (_, vs, _, _) -> vs

(** val few_of : tree -> tree -> vertex list **)

let few_of x y =
  match own x with
  | [] -> []
  | v :: l ->
    (match own y with
     | [] -> []
     | v0 :: l0 ->
       let vs = union (fun v1 -> v1.vid) (v :: l) (v0 :: l0) in
       if at_most Zint.few vs then vs else [])

(** val collect : tree -> vertex list -> vertex list **)

let rec collect x acc =
  match x with
  | Leaf (_, vs) -> List.rev_append vs acc
  | Node (_, vs, l, r) ->
    (match vs with
     | [] -> collect l (collect r acc)
     | _ :: _ -> List.rev_append vs acc)

(** val verts : tree -> vertex list **)

let verts x = match x with
| Leaf (_, vs) -> vs
| Node (_, vs, _, _) -> (match vs with
                         | [] -> collect x []
                         | _ :: _ -> vs)

(** val label_of : tree -> Zint.t option **)

let label_of = function
| Leaf (l, _) -> Some l
| Node (l, _, _, _) -> l

(** val common_label : tree -> tree -> Zint.t option **)

let common_label x y =
  match label_of x with
  | Some l ->
    (match label_of y with
     | Some m -> if Zint.equal l m then Some l else None
     | None -> None)
  | None -> None

(** val cell_ids : (Zint.t -> Zint.t) -> scene -> Zint.t -> Zint.t list **)

let cell_ids f s i =
  (fun f a l -> List.fold_right f l a) (fun v acc ->
    union (fun u -> u) ((f v) :: []) acc) [] (s.cell i)

(** val group_ids : (Zint.t -> Zint.t) -> scene -> group -> Zint.t list **)

let rec group_ids f s = function
| Cell i -> cell_ids f s i
| Join (l, r) -> union (fun u -> u) (group_ids f s l) (group_ids f s r)

(** val vertices :
    (Zint.t -> vertex) -> Zint.t list -> (Zint.t * vertex search) list ->
    (Zint.t * vertex search) list **)

let rec vertices make ids acc =
  match ids with
  | [] -> List.rev_append acc []
  | v :: r -> vertices make r ((v, (Found (make v))) :: acc)

(** val look_up : vertex search -> Zint.t -> vertex option **)

let look_up table v =
  let w = find (fun k -> Zint.leq k v) table in
  if Zint.equal w.vid v then Some w else None

(** val look_up_all : vertex search -> Zint.t list -> vertex list option **)

let rec look_up_all table = function
| [] -> Some []
| v :: r ->
  (match look_up table v with
   | Some w ->
     (match look_up_all table r with
      | Some l -> Some (w :: l)
      | None -> None)
   | None -> None)

(** val build_from : vertex search -> scene -> group -> tree option **)

let rec build_from table s = function
| Cell i ->
  (match look_up_all table (cell_ids s.same s i) with
   | Some vs -> Some (Leaf ((s.label i), vs))
   | None -> None)
| Join (l, r) ->
  (match build_from table s l with
   | Some x ->
     (match build_from table s r with
      | Some y -> Some (Node ((common_label x y), (few_of x y), x, y))
      | None -> None)
   | None -> None)

(** val build_by :
    (Zint.t -> bool) -> (Zint.t list -> Zint.t) -> (Zint.t -> Zint.t ->
    vertex) -> scene -> group -> tree option **)

let build_by wf bits make s g =
  if List.for_all wf (group_ids (fun v -> v) s g)
  then let ids = group_ids s.same s g in
       (match join_all ids (vertices (make (bits ids)) ids []) with
        | Some table -> build_from table s g
        | None -> None)
  else None

(** val ids_of : group -> Zint.t list **)

let rec ids_of = function
| Cell i -> i :: []
| Join (l, r) -> union (fun i -> i) (ids_of l) (ids_of r)

(** val size : group -> Zint.t **)

let rec size = function
| Cell _ -> Zint.one
| Join (l, r) -> Zint.add (size l) (size r)

(** val is_range : Zint.t -> Zint.t -> Zint.t list -> bool **)

let rec is_range k n = function
| [] -> Zint.equal k n
| i :: r -> (&&) (Zint.equal i k) (is_range (Zint.add k Zint.one) n r)

(** val covers : Zint.t -> group -> bool **)

let covers n g =
  (&&) (Zint.equal (size g) n) (is_range Zint.zero n (ids_of g))

(** val excluded_pair : scene -> Zint.t -> Zint.t -> bool **)

let excluded_pair s l m =
  List.exists (fun p ->
    (||) ((&&) (Zint.equal (fst p) l) (Zint.equal (snd p) m))
      ((&&) (Zint.equal (fst p) m) (Zint.equal (snd p) l))) s.excluded

(** val excluded_labels : scene -> Zint.t option -> Zint.t option -> bool **)

let excluded_labels s o p =
  match o with
  | Some l -> (match p with
               | Some m -> excluded_pair s l m
               | None -> false)
  | None -> false

(** val has : Zint.t -> vertex list -> bool **)

let has v l =
  List.exists (fun w -> Zint.equal w.vid v) l

(** val without : Zint.t -> vertex list -> vertex list **)

let without v l =
  List.filter (fun w -> not (Zint.equal w.vid v)) l

(** val nth_id : Zint.t -> vertex list -> Zint.t option **)

let rec nth_id k = function
| [] -> None
| w :: r ->
  if Zint.equal k Zint.zero
  then Some w.vid
  else nth_id (Zint.sub k Zint.one) r

(** val in_cell : scene -> Zint.t -> Zint.t -> bool **)

let in_cell s i v =
  (&&) ((&&) (Zint.leq Zint.zero i) (Zint.lt i s.ncell))
    (List.exists (fun u -> Zint.equal (s.same u) v) (s.cell i))

(** val way_end : scene -> Zint.t -> Zint.t -> way -> Zint.t option **)

let rec way_end s n v = function
| [] -> Some v
| p :: r ->
  let (i, u) = p in
  if (&&) ((&&) (Zint.lt Zint.zero n) (in_cell s i v)) (in_cell s i u)
  then way_end s (Zint.sub n Zint.one) u r
  else None

(** val way_ends :
    scene -> Zint.t -> Zint.t -> way list -> Zint.t list option **)

let rec way_ends s n v = function
| [] -> Some []
| w :: r ->
  (match way_end s n v w with
   | Some u ->
     (match way_ends s n v r with
      | Some l -> Some (u :: l)
      | None -> None)
   | None -> None)

(** val without_all : Zint.t list -> vertex list -> vertex list **)

let without_all us l =
  List.filter (fun w -> not (List.exists (fun u -> Zint.equal u w.vid) us)) l

type mode =
| Distance
| Far
| Disjoint

type obligation =
| Pair of tree * tree * mode * Zint.t * Zint.t * Zint.t
| Self of tree * mode * Zint.t * Zint.t * Zint.t

(** val least : scene -> mode -> Zint.t **)

let least s = function
| Disjoint -> Zint.zero
| _ -> s.eta

(** val step_pair :
    scene -> tree -> tree -> mode -> Zint.t -> Zint.t -> Zint.t -> obligation
    list -> token -> obligation list option **)

let step_pair s x y o a b d k = function
| THalve ->
  if Zint.lt d Zint.d_max
  then let m = Zint.add a b in
       let d2 = Zint.add d d in
       Some ((Pair (x, y, o, (Zint.add a a), m, d2)) :: ((Pair (x, y, o, m,
       (Zint.add b b), d2)) :: k))
  else None
| TLeft ->
  (match x with
   | Leaf (_, _) -> None
   | Node (_, _, l, r) ->
     Some ((Pair (l, y, o, a, b, d)) :: ((Pair (r, y, o, a, b, d)) :: k)))
| TRight ->
  (match y with
   | Leaf (_, _) -> None
   | Node (_, _, l, r) ->
     Some ((Pair (x, l, o, a, b, d)) :: ((Pair (x, r, o, a, b, d)) :: k)))
| TDrop i ->
  (match x with
   | Leaf (l, p) ->
     (match y with
      | Leaf (m, q) ->
        (match nth_id i (List.filter (fun w -> has w.vid q) p) with
         | Some v ->
           Some ((Pair ((Leaf (l, (without v p))), y, o, a, b, d)) :: ((Pair
             (x, (Leaf (m, (without v q))), o, a, b, d)) :: k))
         | None -> None)
      | Node (_, _, _, _) -> None)
   | Node (_, _, _, _) -> None)
| TRing (v, ws) ->
  (match x with
   | Leaf (l, p) ->
     (match y with
      | Leaf (m, q) ->
        (match way_ends s (Zint.sub s.ring Zint.one) v ws with
         | Some us ->
           if (&&) (has v p) (List.for_all (fun u -> has u q) us)
           then let x' = Leaf (l, (without v p)) in
                let y' = Leaf (m, (without_all us q)) in
                (match o with
                 | Distance ->
                   Some ((Pair (x', y, o, a, b, d)) :: ((Pair (x, y', o, a,
                     b, d)) :: ((Pair (x, y, Disjoint, a, b, d)) :: k)))
                 | Far ->
                   Some ((Pair (x', y, o, a, b, d)) :: ((Pair (x, y', o, a,
                     b, d)) :: k))
                 | Disjoint -> None)
           else None
         | None -> None)
      | Node (_, _, _, _) -> None)
   | Node (_, _, _, _) -> None)
| TFar ->
  (match o with
   | Distance ->
     Some ((Pair (x, y, Far, a, b, d)) :: ((Pair (x, y, Disjoint, a, b,
       d)) :: k))
   | _ -> None)
| TPlane (h, w) ->
  if apart_by_plane (least s o) h w a b d (verts x) (verts y)
  then Some k
  else None
| TDirection n ->
  if separated s.tbeg s.tend (least s o) n a b d (verts x) (verts y)
  then Some k
  else None
| TExcluded ->
  if excluded_labels s (label_of x) (label_of y) then Some k else None
| _ -> None

(** val step_self :
    bool -> scene -> tree -> mode -> Zint.t -> Zint.t -> Zint.t -> obligation
    list -> token -> obligation list option **)

let step_self strict s x o a b d k = function
| THalve ->
  if Zint.lt d Zint.d_max
  then let m = Zint.add a b in
       let d2 = Zint.add d d in
       Some ((Self (x, o, (Zint.add a a), m, d2)) :: ((Self (x, o, m,
       (Zint.add b b), d2)) :: k))
  else None
| TExcluded ->
  if excluded_labels s (label_of x) (label_of x) then Some k else None
| TParts ->
  (match x with
   | Leaf (_, _) -> None
   | Node (_, _, l, r) ->
     Some ((Self (l, o, a, b, d)) :: ((Pair (l, r, o, a, b, d)) :: ((Self (r,
       o, a, b, d)) :: k))))
| TOne ->
  (match x with
   | Leaf (_, _) -> if strict then None else Some k
   | Node (_, _, _, _) -> None)
| TBoth -> Some ((Pair (x, x, o, a, b, d)) :: k)
| _ -> None

(** val step :
    bool -> scene -> obligation list -> token -> obligation list option **)

let step strict s st tok =
  match st with
  | [] -> None
  | o0 :: k ->
    (match o0 with
     | Pair (x, y, o, a, b, d) -> step_pair s x y o a b d k tok
     | Self (x, o, a, b, d) -> step_self strict s x o a b d k tok)

(** val start_by :
    (group -> tree option) -> scene -> group -> obligation list option **)

let start_by make s g =
  if (&&)
       ((&&)
         ((&&) ((&&) (Zint.lt s.tbeg s.tend) (Zint.lt Zint.zero s.ncell))
           (Zint.leq Zint.zero s.eta)) (Zint.lt Zint.zero s.ring))
       (covers s.ncell g)
  then (match make g with
        | Some x ->
          Some ((Self (x,
            (if Zint.lt Zint.zero s.eta then Distance else Disjoint), s.tbeg,
            s.tend, Zint.one)) :: [])
        | None -> None)
  else None
