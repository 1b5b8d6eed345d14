(* SPDX-License-Identifier: Apache-2.0 *)
(** * The checker: integer computations, no proofs

    A proof is a binary tree over the cells and a stream of tokens, in prefix
    order.  The tokens rewrite a stack of obligations; the proof is accepted if
    the stack is empty after the last token.  What acceptance means is in Spec.v,
    why in Sound.v.

    Notation: an obligation's interval is [a/d, b/d], where [d] is 2^e for the
    number e of halvings; [c] is a time with the same denominator; [o] is a mode.  The
    vertices of a group come with search trees of their trajectories, in increasing order
    of their ids, which are those that stand for others ([same] in Spec.v).

    Cost: of S, a few small numbers for each vertex if quick bounds settle it; else, and of P,
    the search in each trajectory, which is logarithmic, and its breakpoints in the interval; if no
    plane is found, for each vertex all breakpoints in the interval of all; of [start], all breakpoints
    a few times, and the sorting of ids.

    Not here: reading bytes, and bounds for the lengths of what is read.  The tree
    is recursed over, so that a reader has to bound its depth. *)
Require Import ZArith List Bool.
From Noli Require Import Spec.
Import ListNotations.
Open Scope Z_scope.

(** ** The language *)

(** The tree: each of its nodes is a group of cells. *)
Inductive group := Cell (i : Z) | Join (l r : group).

(** The half of space-time where  n.p + nt t - nd > 0, for a position p at time t. *)
Record halfspace := HalfSpace { normal : vec; nt : Z; nd : Z }.

(** A way from one vertex to another over edges: each step is a cell, and the next vertex in it. *)
Definition way : Type := list (Z * Z).

Inductive token :=
| THalve                            (* T  any:  both halves of the interval                          *)
| TLeft                             (* L  pair: each of the two parts of the first group             *)
| TRight                            (* R  pair: each of the two parts of the second group            *)
| TDrop (k : Z)                     (* D  two cells: without their k-th common vertex, first, second *)
| TRing (v : Z) (ws : list way)     (* W  two cells: without v, without the ends of ways from v      *)
| TFar                              (* G  pair: far first, disjoint second                           *)
| TPlane (h : halfspace) (w : Z)    (* P  pair: the first group is in h, the second w behind it      *)
| TDirection (n : vec)              (* S  pair: the first group is always further in direction n     *)
| TExcluded                         (* X  any:  nothing is claimed about these labels                *)
| TParts                            (* N  self: the first part, the pair of both, the second part    *)
| TOne                              (* F  self: one cell; nothing to show, if not strict             *)
| TBoth.                            (* B  self: as a pair of the group with itself                   *)

(** ** Trajectories *)

(** Times increase strictly from [t0] on, and the last is [T] or after. *)
Fixpoint reaches {A} (t0 T : Z) (r : list (Z * A)) : bool :=
  match r with
  | [] => T <=? t0
  | (t1, _) :: r' => (t0 <? t1) && reaches t1 T r'
  end.

(** A trajectory is as Spec.v's [covers_time] has it. *)
Definition wf_traj (T0 T1 : Z) (tr : traj) : bool :=
  match tr with
  | [] => false
  | (t0, _) :: r => (t0 <=? T0) && reaches t0 T1 r
  end.

(** Two trajectories are equal. *)
Fixpoint equal_traj (tr1 tr2 : traj) : bool :=
  match tr1, tr2 with
  | [], [] => true
  | (t1, p1) :: r1, (t2, p2) :: r2 =>
      if (t1 =? t2) && (vx p1 =? vx p2) && (vy p1 =? vy p2) && (vz p1 =? vz p2) then equal_traj r1 r2 else false
  | _, _ => false
  end.

(** ** Search: in a trajectory, and among all vertices

    A search tree has things in increasing order of their keys.  Its lists are built
    and taken apart in constant stack, in time proportional to their length. *)

(** What is at [k] or after is in [r], what is before in [l]. *)
Inductive search (A : Type) :=
| Found (x : A)
| Choose (k : Z) (l r : search A).
Arguments Found {A} _.
Arguments Choose {A} _ _ _.

(** The last thing whose key is [low], or the first if none is: all keys before one
    that is [low] are. *)
Fixpoint find {A} (low : Z -> bool) (x : search A) : A :=
  match x with
  | Found x => x
  | Choose k l r => if low k then find low r else find low l
  end.

(** Each two neighbours of a list of keys and trees as one; [acc] has the earlier ones, last first. *)
Fixpoint join_pairs {A} (l acc : list (Z * search A)) : list (Z * search A) :=
  match l with
  | (k1, x) :: (k2, y) :: r => join_pairs r ((k1, Choose k2 x y) :: acc)
  | _ => rev_append acc l
  end.

(** One tree of all: half as many remain after each round.  [fuel] is any list that is
    longer than there are rounds. *)
Fixpoint join_all {A B} (fuel : list B) (l : list (Z * search A)) : option (search A) :=
  match l with
  | [] => None
  | (_, x) :: r =>
      match r, fuel with
      | _ :: _, _ :: f => join_all f (join_pairs l [])
      | _, _ => Some x
      end
  end.

(** A trajectory's suffixes, each with the time at which it begins.  They share memory. *)
Fixpoint suffixes (tr : traj) (acc : list (Z * search traj)) : list (Z * search traj) :=
  match tr with
  | [] => rev_append acc []
  | (t, _) :: r => suffixes r ((t, Found tr) :: acc)
  end.

(** The search tree of a trajectory: of its suffixes, by their times. *)
Definition index (tr : traj) : search traj :=
  match join_all tr (suffixes tr []) with
  | Some x => x
  | None => Found tr
  end.

(** The trajectory from its last breakpoint at [a/d] or before on. *)
Definition since (d a : Z) (x : search traj) : traj := find (fun t => t * d <=? a) x.

(** ** P: a half of space-time *)

(** How far [p] is in direction [n]. *)
Definition dot (n p : vec) : Z := vx n * vx p + vy n * vy p + vz n * vz p.

(** Positive in [h], negative outside. *)
Definition value (h : halfspace) (t : Z) (p : vec) : Z :=
  dot (normal h) p + nt h * t - nd h.

(** The direction the other way. *)
Definition opposite (n : vec) : vec := V3 (- vx n) (- vy n) (- vz n).

(** The half of space-time where the value of [h] is less than [-w]. *)
Definition behind (h : halfspace) (w : Z) : halfspace :=
  HalfSpace (opposite (normal h)) (- nt h) (w - nd h).

(** Points p and q with  n.p - n.q > w  are more than [e] apart, because the length of
    [n] is at most w/e.  If [e] is 0, any [w] >= 0 will do. *)
Definition wide (e : Z) (n : vec) (w : Z) : bool := (0 <=? w) && (e * e * dot n n <=? w * w).

(** A linear function with the values [g0] at [s0/d] and [g1] at [s1/d] is positive
    at the ends of the segment clipped to [a/d, b/d]. *)
Definition segment_positive (a b s0 g0 s1 g1 : Z) : bool :=
  (if a <=? s0 then 0 <? g0 else 0 <? g0 * (s1 - a) + g1 * (a - s0)) &&
  (if s1 <=? b then 0 <? g1 else 0 <? g0 * (s1 - b) + g1 * (b - s0)).

(** [h] is positive on [a/d, b/d], from the breakpoint at [t0], with value [g0], on. *)
Fixpoint inside_from (h : halfspace) (a b d t0 g0 : Z) (r : traj) : bool :=
  match r with
  | [] => false
  | (t1, p1) :: r' =>
      let g1 := value h t1 p1 in
      let s1 := t1 * d in
      if segment_positive a b (t0 * d) g0 s1 g1
      then if b <=? s1 then true else inside_from h a b d t1 g1 r'
      else false
  end.

(** A trajectory is in [h] during [a/d, b/d]. *)
Definition inside (h : halfspace) (a b d : Z) (x : search traj) : bool :=
  match since d a x with
  | [] => false
  | (t0, p0) :: r => inside_from h a b d t0 (value h t0 p0) r
  end.

(** ** Quick bounds for S

    Nearly all groups that a direction separates are further apart than their vertices stray
    from straight lines.  So each vertex comes with a [chord]: the straight line from where it is
    at the scene's first time, [T0], to where it is at its last, and how far its breakpoints are away
    from that, in integers that the machine multiplies by itself.  They are in units of 2^s, [s] being
    one number for the scene, and rounded; [u] is the part of the time from [T0] to [T1] that has
    gone by, in units of 2^-20.  Over [a/d, b/d], which is the [j]-th of [d] parts of that time, bounds of
    a group are linear in time, so that two ends tell.

    Not here: bounds from the breakpoints of a part of the time alone; trajectories that begin before
    [T0] or end after [T1], which have no chord; directions and motions that are too long for words.  What bounds do not settle, a plane or the walk below do. *)

(** How many bits positions have, and [u] has, and up to which [d] parts are looked at.  Any numbers
    do; with these, those of a token are below 2^62 for directions of 10 bits, unless vertices leave by far
    the places where they begin. *)
Definition place_bits : Z := 40.
Definition time_bits : Z := 20.
Definition half_bits : Z := 10.
Definition d_quick : Z := 2 ^ 8.

Definition lesser (a b : Z) : Z := if b <? a then b else a.
Definition greater (a b : Z) : Z := if a <? b then b else a.

(** An operation, axis by axis. *)
Definition by_axis (f : Z -> Z -> Z) (p q : vec) : vec :=
  V3 (f (vx p) (vx q)) (f (vy p) (vy q)) (f (vz p) (vz q)).

(** In units of [grain], 2^s: a vertex goes from [origin] as far as [motion]; at each time it is
    from [lows] to [highs] away from there. *)
Record chord := Chord { grain : Z; origin : vec; motion : vec; lows : vec; highs : vec }.

(** The number [s] of scenes in which vertices begin at these trajectories' first breakpoints. *)
Definition unit_bits (path : Z -> traj) (ids : list Z) : Z :=
  let most m v := match path v with
    | [] => m
    | (_, p) :: _ => greater m (greater (Z.abs (vx p)) (greater (Z.abs (vy p)) (Z.abs (vz p))))
    end in
  greater 0 (Z.log2 (fold_left most ids 0) - place_bits).

(** A position in units. *)
Definition coarse (s : Z) (p : vec) : vec := V3 (Z.shiftr (vx p) s) (Z.shiftr (vy p) s) (Z.shiftr (vz p) s).

(** The last breakpoint, if [t], [p] is the one before [r]. *)
Fixpoint last_from {A} (t : Z) (p : A) (r : list (Z * A)) : Z * A :=
  match r with [] => (t, p) | (t1, p1) :: r' => last_from t1 p1 r' end.

(** The part [t] of the time [W], in units of 2^-20: [t] times 2^20 by [W], in two steps, for
    whose numbers the machine's integers are long enough if those for [W] have 10 bits to spare. *)
Definition part (t W : Z) : Z :=
  let t' := Z.shiftl t half_bits in
  let q := t' / W in
  Z.shiftl q half_bits + Z.shiftl (t' - q * W) half_bits / W.

(** How far a breakpoint, with a coarse position, is from the chord, less than [slack] too much or too little. *)
Definition stray (T0 W : Z) (o w : vec) (t : Z) (p : vec) : vec :=
  let u := part (t - T0) W in
  let on p o w := p - (o + Z.shiftr (w * u) time_bits) in
  V3 (on (vx p) (vx o) (vx w)) (on (vy p) (vy o) (vy w)) (on (vz p) (vz o) (vz w)).
Definition slack (w : Z) : Z := Z.shiftr (Z.abs w) time_bits + 1 + 1.

(** The least and the greatest of breakpoints, and of those before; [f] gives coarse positions. *)
Fixpoint strays {A} (f : A -> vec) (T0 W : Z) (o w : vec) (r : list (Z * A)) (l h : vec) : vec * vec :=
  match r with
  | [] => (l, h)
  | (t, p) :: r' =>
      let e := stray T0 W o w t (f p) in
      strays f T0 W o w r' (by_axis lesser l e) (by_axis greater h e)
  end.

(** The chord of a trajectory that begins at [T0] and ends at [T1]; [f] gives coarse positions. *)
Definition chord_by {A} (f : A -> vec) (s T0 T1 : Z) (tr : list (Z * A)) : option chord :=
  match tr with
  | [] => None
  | (t0, p0) :: r =>
      let e := last_from t0 p0 r in
      if (t0 =? T0) && (fst e =? T1) && (T0 <? T1) then
        let o := f p0 in
        let w := by_axis Z.sub (f (snd e)) o in
        let lh := strays f T0 (T1 - T0) o w r (V3 0 0 0) (V3 0 0 0) in
        Some (Chord (Z.shiftl 1 s) o w
          (by_axis (fun l w => l - slack w) (fst lh) w) (by_axis (fun h w => h + slack w) (snd lh) w))
      else None
  end.
Definition chord_of (s T0 T1 : Z) (tr : traj) : option chord := chord_by (coarse s) s T0 T1 tr.

(** *** In integers of the machine

    What is looked at for each token is kept in [word]s: integers that the machine adds and multiplies without looking at
    their length, which it does modulo 2^63. Numbers are compared with bounds before they become words, so that nothing
    here is 2^62 or more, and what is computed is what integers would give. *)

(** An integer that is at least -2^62 and less than 2^62. *)
Inductive word := Word (z : Z).
Definition val (a : word) : Z := match a with Word z => z end.
Definition to_word (z : Z) : word := Word ((z + 2 ^ 62) mod 2 ^ 63 - 2 ^ 62).
Definition word_add (a b : word) : word := to_word (val a + val b).
Definition word_mul (a b : word) : word := to_word (val a * val b).
Definition word_lt (a b : word) : bool := val a <? val b.
Definition word_zero : word := to_word 0.
Definition word_most : word := to_word (2 ^ 62 - 1).
Definition word_lesser (a b : word) : word := if word_lt b a then b else a.

(** Up to here, positions and motions become words, and directions do. *)
Definition most_place : Z := 2 ^ 41.
Definition most_direction : Z := 2 ^ 9.
Definition short (most : Z) (p : vec) : bool :=
  (Z.abs (vx p) <=? most) && (Z.abs (vy p) <=? most) && (Z.abs (vz p) <=? most).

(** A chord in words: a vertex begins between the corners [l] and [h] of a box, which moves by [m]. *)
Record band := Band { grid : Z; lx : word; ly : word; lz : word; hx : word; hy : word; hz : word;
                      mx : word; my : word; mz : word }.

Definition band_of (c : chord) : option band :=
  let l := by_axis Z.add (origin c) (lows c) in
  let h := by_axis Z.add (origin c) (highs c) in
  let m := motion c in
  if short most_place l && short most_place h && short most_place m then
    Some (Band (grain c) (to_word (vx l)) (to_word (vy l)) (to_word (vz l))
      (to_word (vx h)) (to_word (vy h)) (to_word (vz h)) (to_word (vx m)) (to_word (vy m)) (to_word (vz m)))
  else None.

(** What is computed when it is asked for, and then kept. *)
Inductive delayed (A : Type) := Delay (f : unit -> A).
Arguments Delay {A} _.
Definition force {A} (x : delayed A) : A := match x with Delay f => f tt end.

(** A vertex: its id, the search tree of its trajectory, which few are asked for, and its band if it has one. *)
Record vertex := Vertex { vid : Z; delayed_trail : delayed (search traj); line : option band }.
Definition trail (v : vertex) : search traj := force (delayed_trail v).

(** The band of a trajectory that begins at [T0] and ends at [T1]. *)
Definition line_of (s T0 T1 : Z) (tr : traj) : option band :=
  match chord_of s T0 T1 tr with Some c => band_of c | None => None end.

(** What one axis contributes to the least of how far in direction [n] a vertex begins. *)
Definition least_on (n l h : word) : word := word_mul n (if word_lt n word_zero then h else l).

(** All of the vertices [x] are at least so far in direction [nx], [ny], [nz], in [d]-th parts of units, when the [j]-th
    part of the time begins and when it ends; so are those before, [g0] and [g1]. *)
Fixpoint least_from (nx ny nz d j : word) (x : list vertex) (g0 g1 : word) : option (word * word) :=
  match x with
  | [] => Some (g0, g1)
  | v :: r =>
      match line v with
      | Some c =>
          let l := word_add (word_add (least_on nx (lx c) (hx c)) (least_on ny (ly c) (hy c)))
                     (least_on nz (lz c) (hz c)) in
          let m := word_add (word_add (word_mul nx (mx c)) (word_mul ny (my c))) (word_mul nz (mz c)) in
          let g := word_add (word_mul d l) (word_mul j m) in
          least_from nx ny nz d j r (word_lesser g0 g) (word_lesser g1 (word_add g m))
      | None => None
      end
  end.

Definition least_of (n : vec) (d j : Z) (x : list vertex) : option (word * word) :=
  least_from (to_word (vx n)) (to_word (vy n)) (to_word (vz n)) (to_word d) (to_word j) x word_most word_most.

(** The unit in which a group is. *)
Definition grain_of (x : list vertex) : option Z :=
  match x with
  | v :: _ => match line v with Some c => Some (grid c) | None => None end
  | [] => None
  end.

(** Bounds show that at all times of [a/d, b/d], all of [x] is further in direction [n] than all of
    [y], by more than the root of [k].  The greatest of [y] is the least in the other direction. *)
Definition apart_by_bounds (T0 T1 k : Z) (n : vec) (a b d : Z) (x y : list vertex) : bool :=
  if (d <=? d_quick) && short most_direction n then
    let W := T1 - T0 in
    let j := (a - T0 * d) / W in
    if (0 <=? j) && (j <=? d_quick) && (b <=? T0 * d + (j + 1) * W) then
      match least_of n d j x, least_of (opposite n) d j y with
      | Some g, Some h =>
          let m := word_lesser (word_add (fst g) (fst h)) (word_add (snd g) (snd h)) in
          if word_lt word_zero m then
            if k =? 0 then true
            else
              match grain_of x with
              | Some e => let f := e * val m in k * (d * d) <? f * f
              | None => false
              end
          else false
      | _, _ => false
      end
    else false
  else false.

(** ** S: a direction, vertex by vertex *)

(** A rational number: numerator, and denominator > 0.  Where vertices have their
    breakpoints at the same times, denominators are equal and numerators compare. *)
Definition rat : Type := Z * Z.

(** [q] is less than [r]. *)
Definition rat_lt (q r : rat) : bool :=
  if snd q =? snd r then fst q <? fst r else fst q * snd r <? fst r * snd q.

(** [r] is greater than [q] by more than the root of [k]. *)
Definition rat_over (k : Z) (q r : rat) : bool :=
  if rat_lt q r then
    if k =? 0 then true
    else
      let g := fst r * snd q - fst q * snd r in
      let h := snd q * snd r in
      k * (h * h) <? g * g
  else false.

(** The lesser of two. *)
Definition rat_min (q r : rat) : rat := if rat_lt q r then q else r.

(** The value at [c/d] of a linear function, [g0] at [s0/d] and [g1] at [s1/d]. *)
Definition between (s0 g0 s1 g1 c : Z) : rat :=
  if c =? s0 then (g0, 1)
  else if c =? s1 then (g1, 1)
  else (g0 * (s1 - c) + g1 * (c - s0), s1 - s0).

(** How far a trajectory is in direction [n] at the times [cs]: from the breakpoint
    at [t0], with value [g0], on, [c'] being the time before [cs] and [acc] the
    values before, last first.  Fails unless [cs] is in order, reaches [b], and has
    all breakpoints between its first and last. *)
Fixpoint along (n : vec) (b d t0 g0 : Z) (r : traj) : Z -> list Z -> list rat -> option (list rat) :=
  match r with
  | [] => fun _ _ _ => None
  | (t1, p1) :: r' =>
      let s0 := t0 * d in
      let s1 := t1 * d in
      let g1 := dot n p1 in
      fix here (c' : Z) (cs : list Z) (acc : list rat) : option (list rat) :=
        match cs with
        | [] => if b <=? c' then Some (rev_append acc []) else None
        | c :: cs' =>
            if c <? c' then None
            else if c <=? s1 then here c cs' (between s0 g0 s1 g1 c :: acc)
            else if s1 <=? c' then along n b d t1 g1 r' c' cs acc
            else None
        end
  end.

(** How far a trajectory is in direction [n] at the times [cs], from [a] to [b]. *)
Definition values (n : vec) (a b d : Z) (cs : list Z) (x : search traj) : option (list rat) :=
  match since d a x with
  | [] => None
  | (t0, p0) :: r =>
      if t0 * d <=? a then along n b d t0 (dot n p0) r a cs [] else None
  end.

(** The breakpoints strictly between [a/d] and [b/d], as times with denominator [d];
    [acc] has the earlier ones, last first. *)
Fixpoint times_until (d a b : Z) (tr : traj) (acc : list Z) : list Z :=
  match tr with
  | [] => rev_append acc []
  | (t, _) :: r =>
      let c := t * d in
      if c <? b then times_until d a b r (if a <? c then c :: acc else acc)
      else rev_append acc []
  end.

(** The same for all of a trajectory. *)
Definition times (d a b : Z) (x : search traj) : list Z := times_until d a b (since d a x) [].

(** The union of two lists in strictly increasing order of [key], in constant stack. *)
Fixpoint union_acc {A} (key : A -> Z) (l1 : list A) : list A -> list A -> list A :=
  match l1 with
  | [] => fun l2 acc => rev_append acc l2
  | x :: r1 =>
    let fix aux (l2 acc : list A) : list A :=
      match l2 with
      | [] => rev_append acc l1
      | y :: r2 =>
        if key x <? key y then union_acc key r1 l2 (x :: acc)
        else if key y <? key x then aux r2 (y :: acc)
        else union_acc key r1 r2 (x :: acc)
      end in aux
  end.
Definition union {A} (key : A -> Z) (l1 l2 : list A) : list A := union_acc key l1 l2 [].

(** The smaller of each two values: the lowest of a group, vertex after vertex. *)
Fixpoint lower_acc (l1 l2 acc : list rat) : list rat :=
  match l1, l2 with
  | q :: r1, r :: r2 => lower_acc r1 r2 (rat_min q r :: acc)
  | _, _ => rev_append acc []
  end.

(** The same for lists that may not be there. *)
Definition lower (o v : option (list rat)) : option (list rat) :=
  match o, v with
  | Some l1, Some l2 => Some (lower_acc l1 l2 [])
  | _, _ => None
  end.

(** Each value of [l2] is greater than that of [l1], by more than the root of [k]. *)
Fixpoint all_less (k : Z) (l1 l2 : list rat) : bool :=
  match l1, l2 with
  | [], [] => true
  | q :: r1, r :: r2 => if rat_over k q r then all_less k r1 r2 else false
  | _, _ => false
  end.

(** At all times of [a/d, b/d], all of [x] is further in direction [n] than all of
    [y], by more than the root of [k].  Positions are linear between the times in [cs]: both ends, and the
    breakpoints between. *)
Definition apart_by_walk (k : Z) (n : vec) (a b d : Z) (x y : list vertex) : bool :=
  match x with
  | [] => true
  | w :: ws =>
      let add cs v := union (fun c => c) (times d a b (trail v)) cs in
      let cs := fold_left add y (fold_left add x [a; b]) in
      let at_times v := values n a b d cs (trail v) in
      match cs with
      | [] => false
      | c :: _ =>
          if c =? a then
            match fold_left (fun l v => lower l (at_times v)) ws (at_times w) with
            | None => false
            | Some low =>
                forallb (fun v => match at_times v with Some l => all_less k l low | None => false end) y
            end
          else false
      end
  end.

(** ** S: a plane

    In a part of the time, where vertices stray less, a plane that moves evenly mostly lies
    between the groups, and shows it at each vertex's own breakpoints.  Any plane may be tried: this
    one is in the middle at both ends of the interval.

    Not here: groups between which there is no such plane. *)

(** [x] is in [h] during [a/d, b/d] and [y] is [w] behind it, which is more than [e]. *)
Definition apart_by_plane (e : Z) (h : halfspace) (w a b d : Z) (x y : list vertex) : bool :=
  if wide e (normal h) w then
    if forallb (fun v => inside h a b d (trail v)) x then
      let h' := behind h w in forallb (fun v => inside h' a b d (trail v)) y
    else false
  else false.

(** How far a trajectory is in direction [n] at [c/d], rounded down. *)
Definition floor_at (n : vec) (d c : Z) (x : search traj) : Z :=
  match since d c x with
  | (t0, p0) :: (t1, p1) :: _ =>
      let q := between (t0 * d) (dot n p0) (t1 * d) (dot n p1) c in fst q / snd q
  | (_, p0) :: [] => dot n p0
  | [] => 0
  end.

(** The least of a group. *)
Definition least_at (n : vec) (d c : Z) (x : list vertex) : Z :=
  match x with
  | v :: r => fold_left (fun m v => lesser m (floor_at n d c (trail v))) r (floor_at n d c (trail v))
  | [] => 0
  end.

(** The plane, and how far [y] has to be behind it: in direction [n], the root of [k].  [n] is
    doubled, so that there is an integer between two others. *)
Definition plane_between (k : Z) (n : vec) (a b d : Z) (x y : list vertex) : halfspace * Z :=
  let n := by_axis Z.add n n in
  let w := if k =? 0 then 0 else Z.sqrt (Z.shiftl k (1 + 1)) + 1 in
  let middle c := Z.shiftr (least_at n d c x - least_at (opposite n) d c y + w) 1 in
  let f := middle a in
  let g := middle b - f in
  let l := b - a in
  (HalfSpace (V3 (l * vx n) (l * vy n) (l * vz n)) (- (g * d)) (f * l - g * a), w * l).

(** ** S: all of it *)

(** A group without vertices. *)
Definition empty (x : list vertex) : bool := match x with [] => true | _ :: _ => false end.

(** At all times of [a/d, b/d], which are from [T0] to [T1], all of [x] is further in direction [n] than
    all of [y], by more than [e] times the length of [n]; or all points are more than [e] apart. *)
Definition separated (T0 T1 e : Z) (n : vec) (a b d : Z) (x y : list vertex) : bool :=
  let k := e * e * dot n n in
  if empty x || empty y then true
  else if apart_by_bounds T0 T1 k n a b d x y then true
  else
    let hw := plane_between k n a b d x y in
    if apart_by_plane e (fst hw) (snd hw) a b d x y then true else apart_by_walk k n a b d x y.

(** ** Groups with their labels and vertices *)

(** A leaf is a cell, or what is left of it, and has a label; a node has the union of
    the vertices below, if they are [few], and the label of all cells below if that is one. *)
Inductive tree :=
| Leaf (l : Z) (vs : list vertex)
| Node (l : option Z) (vs : list vertex) (x y : tree).

(** Up to which number a node has them.  Any number does; with this one, large nodes do not take most of the memory. *)
Definition few : Z := 2 ^ 10.

(** A list is not longer than [k]. *)
Fixpoint at_most {A} (k : Z) (l : list A) : bool :=
  match l with [] => true | _ :: r => (0 <? k) && at_most (k - 1) r end.

(** The vertices that it has itself. *)
Definition own (x : tree) : list vertex :=
  match x with Leaf _ vs => vs | Node _ vs _ _ => vs end.

(** The vertices of two groups as one, in order of their ids, if both have them and they are few. *)
Definition few_of (x y : tree) : list vertex :=
  match own x, own y with
  | (_ :: _) as p, (_ :: _) as q => let vs := union vid p q in if at_most few vs then vs else []
  | _, _ => []
  end.

(** The vertices of a group, those of several parts more than once; and [acc]. *)
Fixpoint collect (x : tree) (acc : list vertex) : list vertex :=
  match x with
  | Node _ [] l r => collect l (collect r acc)
  | Leaf _ vs | Node _ vs _ _ => rev_append vs acc
  end.
Definition verts (x : tree) : list vertex :=
  match x with
  | Node _ [] _ _ => collect x []
  | Leaf _ vs | Node _ vs _ _ => vs
  end.

(** The label of all its cells, if that is one. *)
Definition label_of (x : tree) : option Z :=
  match x with Leaf l _ => Some l | Node l _ _ _ => l end.

(** The label of all cells of two groups, if that is one. *)
Definition common_label (x y : tree) : option Z :=
  match label_of x, label_of y with
  | Some l, Some m => if l =? m then Some l else None
  | _, _ => None
  end.

(** The ids of a cell's vertices, or with [f] = [same s] of those that stand for them,
    in order, each once. *)
Definition cell_ids (f : Z -> Z) (s : scene) (i : Z) : list Z :=
  fold_right (fun v acc => union (fun u => u) [f v] acc) [] (cell s i).

(** The same for all cells of a group. *)
Fixpoint group_ids (f : Z -> Z) (s : scene) (g : group) : list Z :=
  match g with
  | Cell i => cell_ids f s i
  | Join l r => union (fun u => u) (group_ids f s l) (group_ids f s r)
  end.

(** A vertex is as Spec.v's [well_formed] has it. *)
Definition wf_vertex (s : scene) (v : Z) : bool :=
  wf_traj (tbeg s) (tend s) (path s v) && ((same s v =? v) || equal_traj (path s (same s v)) (path s v)).

(** The vertex [v], with its band in units of 2^e. *)
Definition vertex_of (s : scene) (e v : Z) : vertex :=
  Vertex v (Delay (fun _ => index (path s v))) (line_of e (tbeg s) (tend s) (path s v)).

(** The vertices with these ids, by their ids: each is made once, however many cells it is in.
    [acc] has the earlier ones, last first. *)
Fixpoint vertices (make : Z -> vertex) (ids : list Z) (acc : list (Z * search vertex)) : list (Z * search vertex) :=
  match ids with
  | [] => rev_append acc []
  | v :: r => vertices make r ((v, Found (make v)) :: acc)
  end.

(** The vertex [v] in a search tree by ids. *)
Definition look_up (table : search vertex) (v : Z) : option vertex :=
  let w := find (fun k => k <=? v) table in
  if vid w =? v then Some w else None.

(** The vertices with these ids. *)
Fixpoint look_up_all (table : search vertex) (ids : list Z) : option (list vertex) :=
  match ids with
  | [] => Some []
  | v :: r =>
      match look_up table v, look_up_all table r with
      | Some w, Some l => Some (w :: l)
      | _, _ => None
      end
  end.

(** The tree with its labels and vertices. *)
Fixpoint build_from (table : search vertex) (s : scene) (g : group) : option tree :=
  match g with
  | Cell i =>
      match look_up_all table (cell_ids (same s) s i) with
      | Some vs => Some (Leaf (label s i) vs)
      | None => None
      end
  | Join l r =>
      match build_from table s l, build_from table s r with
      | Some x, Some y => Some (Node (common_label x y) (few_of x y) x y)
      | _, _ => None
      end
  end.

(** The tree of a scene; [None] if a vertex makes no sense.  The vertices in it are those
    that stand for others, or for themselves.  [wf] tells which vertices make sense, [bits] the unit of bands from
    the ids, [make] makes a vertex with its band in such units. *)
Definition build_by (wf : Z -> bool) (bits : list Z -> Z) (make : Z -> Z -> vertex) (s : scene) (g : group)
  : option tree :=
  if forallb wf (group_ids (fun v => v) s g) then
    let ids := group_ids (same s) s g in
    match join_all ids (vertices (make (bits ids)) ids []) with
    | Some table => build_from table s g
    | None => None
    end
  else None.
Definition build (s : scene) : group -> option tree := build_by (wf_vertex s) (unit_bits (path s)) (vertex_of s) s.

(** The cells of a tree, in order, each once. *)
Fixpoint ids_of (g : group) : list Z :=
  match g with
  | Cell i => [i]
  | Join l r => union (fun i => i) (ids_of l) (ids_of r)
  end.

(** The number of leaves. *)
Fixpoint size (g : group) : Z :=
  match g with Cell _ => 1 | Join l r => size l + size r end.

(** A list is k, k+1, .. n-1. *)
Fixpoint is_range (k n : Z) (l : list Z) : bool :=
  match l with
  | [] => k =? n
  | i :: r => (i =? k) && is_range (k + 1) n r
  end.

(** The leaves of the tree are the cells 0 .. n-1, each once. *)
Definition covers (n : Z) (g : group) : bool := (size g =? n) && is_range 0 n (ids_of g).

(** ** X: pairs of labels about which nothing is claimed *)

(** The unordered pair [l], [m] is in the scene's list. *)
Definition excluded_pair (s : scene) (l m : Z) : bool :=
  existsb (fun p => ((fst p =? l) && (snd p =? m)) || ((fst p =? m) && (snd p =? l))) (excluded s).

(** There is one label in each of two groups, and the pair is in the list. *)
Definition excluded_labels (s : scene) (o p : option Z) : bool :=
  match o, p with
  | Some l, Some m => excluded_pair s l m
  | _, _ => false
  end.

(** ** D: common vertices *)

(** The vertex [v] is in a list. *)
Definition has (v : Z) (l : list vertex) : bool := existsb (fun w => vid w =? v) l.

(** A list without the vertex [v]. *)
Definition without (v : Z) (l : list vertex) : list vertex := filter (fun w => negb (vid w =? v)) l.

(** The id of the [k]-th vertex, the first being number 0. *)
Fixpoint nth_id (k : Z) (l : list vertex) : option Z :=
  match l with
  | [] => None
  | w :: r => if k =? 0 then Some (vid w) else nth_id (k - 1) r
  end.

(** ** W: ways from vertex to vertex *)

(** The vertex [v] is in the cell [i], or stands for one that is. *)
Definition in_cell (s : scene) (i v : Z) : bool :=
  (0 <=? i) && (i <? ncell s) && existsb (fun u => same s u =? v) (cell s i).

(** Where the way [w] leads from [v] in at most [n] steps. *)
Fixpoint way_end (s : scene) (n v : Z) (w : way) : option Z :=
  match w with
  | [] => Some v
  | (i, u) :: r => if (0 <? n) && in_cell s i v && in_cell s i u then way_end s (n - 1) u r else None
  end.

(** Where several ways lead from [v]. *)
Fixpoint way_ends (s : scene) (n v : Z) (ws : list way) : option (list Z) :=
  match ws with
  | [] => Some []
  | w :: r =>
      match way_end s n v w, way_ends s n v r with
      | Some u, Some l => Some (u :: l)
      | _, _ => None
      end
  end.

(** A list without several vertices. *)
Definition without_all (us : list Z) (l : list vertex) : list vertex :=
  filter (fun w => negb (existsb (fun u => u =? vid w) us)) l.

(** ** The stack *)

(** What is to be shown of two features: if they share no vertex, that they are disjoint
    (not [Far]); if they are far by Spec.v's [far_ids], that they are more than [eta] apart
    (not [Disjoint]). *)
Inductive mode := Distance | Far | Disjoint.

(** Every feature of a cell in [x] against every one of a cell in [y], or of every
    two cells in [x] (and of each with itself, if strict), over [a/d, b/d]. *)
Inductive obligation :=
| Pair (x y : tree) (o : mode) (a b d : Z)
| Self (x : tree) (o : mode) (a b d : Z).

(** How far apart separated groups have to be. *)
Definition least (s : scene) (o : mode) : Z := match o with Disjoint => 0 | Distance | Far => eta s end.

(** Halvings beyond this denominator are refused: it bounds the length of numbers. *)
Definition d_max : Z := 2 ^ 1024.

Section Steps.
Variable strict : bool.
Variable s : scene.

(** One token on a pair, and on a group with itself; [k] is the rest of the stack. *)
Definition step_pair (x y : tree) (o : mode) (a b d : Z) (k : list obligation) (tok : token)
  : option (list obligation) :=
  match tok with
  | TDirection n =>
      if separated (tbeg s) (tend s) (least s o) n a b d (verts x) (verts y) then Some k else None
  | TPlane h w =>
      if apart_by_plane (least s o) h w a b d (verts x) (verts y) then Some k else None
  | THalve =>
      if d <? d_max then
        let m := a + b in
        let d2 := d + d in
        Some (Pair x y o (a + a) m d2 :: Pair x y o m (b + b) d2 :: k)
      else None
  | TLeft =>
      match x with
      | Node _ _ l r => Some (Pair l y o a b d :: Pair r y o a b d :: k)
      | Leaf _ _ => None
      end
  | TRight =>
      match y with
      | Node _ _ l r => Some (Pair x l o a b d :: Pair x r o a b d :: k)
      | Leaf _ _ => None
      end
  | TDrop i =>
      match x, y with
      | Leaf l p, Leaf m q =>
          match nth_id i (filter (fun w => has (vid w) q) p) with
          | Some v => Some (Pair (Leaf l (without v p)) y o a b d :: Pair x (Leaf m (without v q)) o a b d :: k)
          | None => None
          end
      | _, _ => None
      end
  | TRing v ws =>
      match x, y with
      | Leaf l p, Leaf m q =>
          match way_ends s (ring s - 1) v ws with
          | Some us =>
              if has v p && forallb (fun u => has u q) us then
                let x' := Leaf l (without v p) in
                let y' := Leaf m (without_all us q) in
                match o with
                | Distance => Some (Pair x' y o a b d :: Pair x y' o a b d :: Pair x y Disjoint a b d :: k)
                | Far => Some (Pair x' y o a b d :: Pair x y' o a b d :: k)
                | Disjoint => None
                end
              else None
          | None => None
          end
      | _, _ => None
      end
  | TFar =>
      match o with
      | Distance => Some (Pair x y Far a b d :: Pair x y Disjoint a b d :: k)
      | Far | Disjoint => None
      end
  | TExcluded => if excluded_labels s (label_of x) (label_of y) then Some k else None
  | TParts | TOne | TBoth => None
  end.

Definition step_self (x : tree) (o : mode) (a b d : Z) (k : list obligation) (tok : token)
  : option (list obligation) :=
  match tok with
  | THalve =>
      if d <? d_max then
        let m := a + b in
        let d2 := d + d in
        Some (Self x o (a + a) m d2 :: Self x o m (b + b) d2 :: k)
      else None
  | TParts =>
      match x with
      | Node _ _ l r => Some (Self l o a b d :: Pair l r o a b d :: Self r o a b d :: k)
      | Leaf _ _ => None
      end
  | TOne =>
      match x with
      | Leaf _ _ => if strict then None else Some k
      | Node _ _ _ _ => None
      end
  | TBoth => Some (Pair x x o a b d :: k)
  | TExcluded => if excluded_labels s (label_of x) (label_of x) then Some k else None
  | TLeft | TRight | TDrop _ | TRing _ _ | TFar | TPlane _ _ | TDirection _ => None
  end.

(** One token: what it puts in place of the obligation on top, or [None]. *)
Definition step (st : list obligation) (tok : token) : option (list obligation) :=
  match st with
  | [] => None
  | Pair x y o a b d :: k => step_pair x y o a b d k tok
  | Self x o a b d :: k => step_self x o a b d k tok
  end.

(** Token after token. *)
Fixpoint run (st : list obligation) (toks : list token) : option (list obligation) :=
  match toks with
  | [] => Some st
  | tok :: r =>
      match step st tok with
      | Some st' => run st' r
      | None => None
      end
  end.
End Steps.

(** The stack before the first token; [None] for a scene or tree that makes no sense. *)
Definition start_by (make : group -> option tree) (s : scene) (g : group) : option (list obligation) :=
  if (tbeg s <? tend s) && (0 <? ncell s) && (0 <=? eta s) && (0 <? ring s) && covers (ncell s) g then
    match make g with
    | Some x => Some [Self x (if 0 <? eta s then Distance else Disjoint) (tbeg s) (tend s) 1]
    | None => None
    end
  else None.
Definition start (s : scene) : group -> option (list obligation) := start_by (build s) s.

(** The answer: all obligations are met, and no token is left over. *)
Definition check (strict : bool) (s : scene) (g : group) (toks : list token) : bool :=
  match start s g with
  | Some st => match run strict s st toks with Some [] => true | _ => false end
  | None => false
  end.
