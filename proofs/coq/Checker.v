(* SPDX-License-Identifier: Apache-2.0 *)
(** * The checker: integer computations, no proofs

    A proof is a binary tree over the cells and a stream of tokens, in prefix
    order.  The tokens rewrite a stack of obligations; the proof is accepted if
    the stack is empty after the last token.  What acceptance means is in Spec.v,
    why in Sound.v.

    Notation: an obligation's interval is [a/d, b/d], where [d] is 2^e for the
    number e of halvings; [c] is a time with the same denominator.  The vertices of
    a group come with their trajectories, in increasing order of their ids.

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

Inductive token :=
| THalve                          (* T  any:  both halves of the interval                          *)
| TLeft                           (* L  pair: each of the two parts of the first group             *)
| TRight                          (* R  pair: each of the two parts of the second group            *)
| TDrop (k : Z)                   (* D  two cells: without their k-th common vertex, first, second *)
| TPlane (h : halfspace) (w : Z)  (* P  pair: the first group is in h, the second w behind it      *)
| TDirection (n : vec)            (* S  pair: the first group is always further in direction n     *)
| TExcluded                       (* X  any:  nothing is claimed about these labels                *)
| TParts                          (* N  self: the first part, the pair of both, the second part    *)
| TOne                            (* F  self: one cell; nothing to show, if not strict             *)
| TBoth.                          (* B  self: as a pair of the group with itself                   *)

(** ** Trajectories *)

(** Times increase strictly from [t0] on, and the last is [T] or after. *)
Fixpoint reaches (t0 T : Z) (r : traj) : bool :=
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

(** The trajectory without the segments that end at [a/d] or before. *)
Fixpoint since (d a : Z) (tr : traj) : traj :=
  match tr with
  | [] => []
  | _ :: r =>
      match r with
      | [] => tr
      | (t1, _) :: _ => if t1 * d <=? a then since d a r else tr
      end
  end.

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
Definition inside (h : halfspace) (a b d : Z) (tr : traj) : bool :=
  match since d a tr with
  | [] => false
  | (t0, p0) :: r => inside_from h a b d t0 (value h t0 p0) r
  end.

(** ** S: a direction *)

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
Definition values (n : vec) (a b d : Z) (cs : list Z) (tr : traj) : option (list rat) :=
  match since d a tr with
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
Definition times (d a b : Z) (tr : traj) : list Z := times_until d a b (since d a tr) [].

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

(** A vertex id with its trajectory. *)
Definition vertex : Type := Z * traj.

(** At all times of [a/d, b/d], all of [x] is further in direction [n] than all of
    [y], by more than the root of [k].  Positions are linear between the times in [cs]: both ends, and the
    breakpoints between. *)
Definition separated (k : Z) (n : vec) (a b d : Z) (x y : list vertex) : bool :=
  match x with
  | [] => true
  | w :: ws =>
      let add cs v := union (fun c => c) (times d a b (snd v)) cs in
      let cs := fold_left add y (fold_left add x [a; b]) in
      let at_times v := values n a b d cs (snd v) in
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

(** ** Groups with their labels and vertices *)

(** A leaf is a cell, or what is left of it, and has a label; a node has the union of
    the vertices below, and the label of all cells below if that is one. *)
Inductive tree :=
| Leaf (l : Z) (vs : list vertex)
| Node (l : option Z) (vs : list vertex) (x y : tree).

(** The vertices of a group. *)
Definition verts (x : tree) : list vertex :=
  match x with Leaf _ vs => vs | Node _ vs _ _ => vs end.

(** The label of all its cells, if that is one. *)
Definition label_of (x : tree) : option Z :=
  match x with Leaf l _ => Some l | Node l _ _ _ => l end.

(** The label of all cells of two groups, if that is one. *)
Definition common_label (x y : tree) : option Z :=
  match label_of x, label_of y with
  | Some l, Some m => if l =? m then Some l else None
  | _, _ => None
  end.

(** The vertices of a cell, each once, with their trajectories. *)
Definition leaf (s : scene) (i : Z) : list vertex :=
  fold_right (fun v acc => union fst [(v, path s v)] acc) [] (cell s i).

(** The tree with its labels and vertices; [None] if a trajectory makes no sense. *)
Fixpoint build (s : scene) (g : group) : option tree :=
  match g with
  | Cell i =>
      let vs := leaf s i in
      if forallb (fun w => wf_traj (tbeg s) (tend s) (snd w)) vs
      then Some (Leaf (label s i) vs) else None
  | Join l r =>
      match build s l, build s r with
      | Some x, Some y => Some (Node (common_label x y) (union fst (verts x) (verts y)) x y)
      | _, _ => None
      end
  end.

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
Definition has (v : Z) (l : list vertex) : bool := existsb (fun w => fst w =? v) l.

(** A list without the vertex [v]. *)
Definition without (v : Z) (l : list vertex) : list vertex := filter (fun w => negb (fst w =? v)) l.

(** The id of the [k]-th vertex, the first being number 0. *)
Fixpoint nth_id (k : Z) (l : list vertex) : option Z :=
  match l with
  | [] => None
  | w :: r => if k =? 0 then Some (fst w) else nth_id (k - 1) r
  end.

(** ** The stack *)

(** Every feature of a cell in [x] against every one of a cell in [y], or of every
    two cells in [x] (and of each with itself, if strict), over [a/d, b/d]. *)
Inductive obligation :=
| Pair (x y : tree) (a b d : Z)
| Self (x : tree) (a b d : Z).

(** Halvings beyond this denominator are refused: it bounds the length of numbers. *)
Definition d_max : Z := 2 ^ 1024.

Section Steps.
Variable strict : bool.
Variable s : scene.

(** One token on a pair, and on a group with itself; [k] is the rest of the stack. *)
Definition step_pair (x y : tree) (a b d : Z) (k : list obligation) (tok : token) : option (list obligation) :=
  match tok with
  | TDirection n => if separated (eta s * eta s * dot n n) n a b d (verts x) (verts y) then Some k else None
  | TPlane h w =>
      if wide (eta s) (normal h) w then
        if forallb (fun v => inside h a b d (snd v)) (verts x) then
          let h' := behind h w in
          if forallb (fun v => inside h' a b d (snd v)) (verts y) then Some k else None
        else None
      else None
  | THalve =>
      if d <? d_max then
        let m := a + b in
        let d2 := d + d in
        Some (Pair x y (a + a) m d2 :: Pair x y m (b + b) d2 :: k)
      else None
  | TLeft =>
      match x with
      | Node _ _ l r => Some (Pair l y a b d :: Pair r y a b d :: k)
      | Leaf _ _ => None
      end
  | TRight =>
      match y with
      | Node _ _ l r => Some (Pair x l a b d :: Pair x r a b d :: k)
      | Leaf _ _ => None
      end
  | TDrop i =>
      match x, y with
      | Leaf l p, Leaf m q =>
          match nth_id i (filter (fun w => has (fst w) q) p) with
          | Some v => Some (Pair (Leaf l (without v p)) y a b d :: Pair x (Leaf m (without v q)) a b d :: k)
          | None => None
          end
      | _, _ => None
      end
  | TExcluded => if excluded_labels s (label_of x) (label_of y) then Some k else None
  | TParts | TOne | TBoth => None
  end.

Definition step_self (x : tree) (a b d : Z) (k : list obligation) (tok : token) : option (list obligation) :=
  match tok with
  | THalve =>
      if d <? d_max then
        let m := a + b in
        let d2 := d + d in
        Some (Self x (a + a) m d2 :: Self x m (b + b) d2 :: k)
      else None
  | TParts =>
      match x with
      | Node _ _ l r => Some (Self l a b d :: Pair l r a b d :: Self r a b d :: k)
      | Leaf _ _ => None
      end
  | TOne =>
      match x with
      | Leaf _ _ => if strict then None else Some k
      | Node _ _ _ _ => None
      end
  | TBoth => Some (Pair x x a b d :: k)
  | TExcluded => if excluded_labels s (label_of x) (label_of x) then Some k else None
  | TLeft | TRight | TDrop _ | TPlane _ _ | TDirection _ => None
  end.

(** One token: what it puts in place of the obligation on top, or [None]. *)
Definition step (st : list obligation) (tok : token) : option (list obligation) :=
  match st with
  | [] => None
  | Pair x y a b d :: k => step_pair x y a b d k tok
  | Self x a b d :: k => step_self x a b d k tok
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
Definition start (s : scene) (g : group) : option (list obligation) :=
  if (tbeg s <? tend s) && (0 <? ncell s) && (0 <=? eta s) && covers (ncell s) g then
    match build s g with
    | Some x => Some [Self x (tbeg s) (tend s) 1]
    | None => None
    end
  else None.

(** The answer: all obligations are met, and no token is left over. *)
Definition check (strict : bool) (s : scene) (g : group) (toks : list token) : bool :=
  match start s g with
  | Some st => match run strict s st toks with Some [] => true | _ => false end
  | None => false
  end.
