(* SPDX-License-Identifier: Apache-2.0 *)
(** * The opposite verdict: a witness that two cells do touch, or come near

    A witness names a time, two cells, and for each of them some of its vertices with
    weights; the two weighted means are the same point, or at most [eta] apart though far
    by Spec.v's [far_ids].  Its checker is integers only, like Checker.v, and
    [check_hit_sound] says that what it accepts is true.

    A contact is seldom at a rational time: where four moving points are in a plane, a
    polynomial of degree 3 is 0.  So the time is a root of a polynomial [g] in an interval,
    and the weights are polynomials in the time.  Nothing is computed at the root: what is
    to be 0 there is divisible by [g], what is to be positive there is so in all the interval.

    Notation: the interval is [l/d, u/d], and [l], [u], [d] are the witness's [wl], [wu],
    [wd]; a side is a list of weights with the segments of their vertices' trajectories.

    Cost: polynomials are of the degree of the weights and some more; [far_apart] goes through
    all cells [ring]-1 times, so that a reader has to bound the ring.

    Not here: that a contact is the first, and that [g] has one root only: all that is shown
    is true at each of its roots in the interval. *)
Require Import ZArith List Bool Reals Lra Lia.
From Noli Require Import Spec Checker Sound Poly.
Import ListNotations.
Open Scope Z_scope.

(** ** The checker *)

Record witness := Witness {
  wi : Z; wj : Z;              (* the cells                          *)
  wp : list (Z * poly);        (* vertices of wi and their weights   *)
  wq : list (Z * poly);        (* vertices of wj and their weights   *)
  wg : poly;                   (* 0 at the time                      *)
  wl : Z; wu : Z; wd : Z       (* which is from wl/wd to wu/wd       *)
}.

(** A segment of a trajectory: its ends, time and position. *)
Record segment := Segment { time0 : Z; place0 : vec; time1 : Z; place1 : vec }.

(** The segment of a trajectory that has all of [l/d, u/d]. *)
Definition segment_of (l u d : Z) (tr : traj) : option segment :=
  match since d l (index tr) with
  | [] => None
  | (t0, p0) :: r =>
      match r with
      | [] => if u <=? t0 * d then Some (Segment t0 p0 (t0 + 1) p0) else None
      | (t1, p1) :: _ => if u <=? t1 * d then Some (Segment t0 p0 t1 p1) else None
      end
  end.

Definition side : Type := list (poly * segment).

(** The weights with their segments. *)
Fixpoint side_of (s : scene) (l u d : Z) (vs : list (Z * poly)) : option side :=
  match vs with
  | [] => Some []
  | (v, a) :: r =>
      match segment_of l u d (path s v), side_of s l u d r with
      | Some p, Some q => Some ((a, p) :: q)
      | _, _ => None
      end
  end.

(** How far a vertex is in direction [n], times the duration of its segment. *)
Definition line (n : vec) (p : segment) : poly :=
  let g0 := dot n (place0 p) in
  let g1 := dot n (place1 p) in
  [g0 * time1 p - g1 * time0 p; g1 - g0].

Definition duration (p : segment) : Z := time1 p - time0 p.

(** The product of all durations. *)
Fixpoint durations (q : side) : Z :=
  match q with [] => 1 | (_, p) :: r => duration p * durations r end.

(** The sum of weights. *)
Fixpoint total (q : side) : poly :=
  match q with [] => [] | (a, _) :: r => add a (total r) end.

(** The sum of how far the vertices are in direction [n], each times its weight, times all durations. *)
Fixpoint moment (n : vec) (q : side) : poly :=
  match q with
  | [] => []
  | (a, p) :: r => add (scale (durations r) (mul a (line n p))) (scale (duration p) (moment n r))
  end.

(** The difference of two means in direction [n], times both totals and all durations. *)
Definition difference (n : vec) (p q : side) : poly :=
  sub (scale (durations q) (mul (moment n p) (total q))) (scale (durations p) (mul (moment n q) (total p))).

(** The two means are the same where [g] is 0. *)
Definition meet (g : poly) (p q : side) : bool :=
  divides g (difference (V3 1 0 0) p q) && divides g (difference (V3 0 1 0) p q) &&
  divides g (difference (V3 0 0 1) p q).

(** The square of [e] less that of the distance of the means, times that of totals and durations. *)
Definition nearness (e : Z) (p q : side) : poly :=
  let square a := mul a a in
  sub (square (scale (e * durations p * durations q) (mul (total p) (total q))))
      (add (square (difference (V3 1 0 0) p q))
           (add (square (difference (V3 0 1 0) p q)) (square (difference (V3 0 0 1) p q)))).

(** Why a polynomial is not negative where [g] is 0. *)
Definition nonnegative_at (l u d : Z) (g p : poly) : bool := divides g p || nonnegative_on l u d p.

Definition member (v : Z) (l : list Z) : bool := existsb (fun u => u =? v) l.

(** The cell, the vertices and weights of a side are as they should be. *)
Definition side_ok (s : scene) (l u d : Z) (g : poly) (i : Z) (vs : list (Z * poly)) : bool :=
  (0 <=? i) && (i <? ncell s) &&
  forallb (fun x => member (fst x) (cell s i) && wf_traj (tbeg s) (tend s) (path s (fst x)) &&
                    nonnegative_at l u d g (snd x)) vs.

(** [f] applied [n] times. *)
Definition repeatedly {A} (n : Z) (f : A -> A) (x : A) : A := Nat.iter (Z.to_nat n) f x.

(** [l] and the vertices, after merging, of each cell that has one in [l]. *)
Definition grown (s : scene) (l : list Z) : list Z :=
  snd (repeatedly (ncell s) (fun x : Z * list Z =>
    let i := fst x in
    (i + 1, if existsb (fun v => member (same s v) l) (cell s i)
            then union (fun v => v) (cell_ids (same s) s i) (snd x) else snd x)) (0, l)).

(** The ids of vertices, after merging. *)
Definition merged (s : scene) (vs : list (Z * poly)) : list Z := map (fun x => same s (fst x)) vs.

(** Two lists of vertices have none in common. *)
Definition disjoint (p q : list Z) : bool := forallb (fun v => negb (member v p)) q.

(** All ways from [p] to [q] have at least [ring] edges. *)
Definition far_apart (s : scene) (p q : list Z) : bool :=
  disjoint (repeatedly (ring s - 1) (grown s) p) q.

Definition check_hit (strict : bool) (s : scene) (w : witness) : bool :=
  let l := wl w in
  let u := wu w in
  let d := wd w in
  let g := wg w in
  (tbeg s <? tend s) && (0 <? d) && (tbeg s * d <=? l) && (l <=? u) && (u <=? tend s * d) &&
  changes_sign l u d g && side_ok s l u d g (wi w) (wp w) && side_ok s l u d g (wj w) (wq w) &&
  (strict || negb (wi w =? wj w)) && negb (excluded_pair s (label s (wi w)) (label s (wj w))) &&
  disjoint (merged s (wp w)) (merged s (wq w)) &&
  match side_of s l u d (wp w), side_of s l u d (wq w) with
  | Some p, Some q =>
      positive_on l u d (total p) && positive_on l u d (total q) &&
      (meet g p q ||
       (0 <? eta s) && far_apart s (merged s (wp w)) (merged s (wq w)) &&
       nonnegative_at l u d g (nearness (eta s) p q))
  | _, _ => false
  end.

(** ** Its soundness *)

Lemma member_in v l : member v l = true <-> In v l.
Proof.
  unfold member; rewrite existsb_exists. split.
  - intros (u & I & E). apply Z.eqb_eq in E; now subst.
  - intros I. exists v. now rewrite Z.eqb_refl.
Qed.

Lemma disjoint_sound p q : disjoint p q = true -> disjoint_ids p q.
Proof.
  unfold disjoint; rewrite forallb_forall. intros H v V1 V2. apply H in V2.
  apply member_in in V1. rewrite V1 in V2. discriminate.
Qed.

Lemma excluded_pair_complete s l m : is_excluded s l m -> excluded_pair s l m = true.
Proof.
  unfold excluded_pair, is_excluded. rewrite existsb_exists.
  intros [I|I]; [exists (l, m)|exists (m, l)]; cbn; rewrite !Z.eqb_refl; cbn; rewrite ?orb_true_r; auto.
Qed.

(** *** Neighbours *)

Lemma cell_ids_map s i v : In v (map (same s) (cell s i)) -> In v (cell_ids (same s) s i).
Proof. intros H. apply in_map_iff in H as (u & <- & Hu). now apply cell_ids_in. Qed.

(** [grown] keeps what it has, and adds what is joined to it. *)
Lemma grown_sound s l : incl l (grown s l) /\ forall u v, In u l -> joined s u v -> In v (grown s l).
Proof.
  unfold grown, repeatedly. set (f := fun x : Z * list Z => _).
  assert (forall n, let x := Nat.iter n f (0, l) in
    fst x = Z.of_nat n /\ incl l (snd x) /\
    forall i u, 0 <= i < Z.of_nat n -> In u l -> In u (map (same s) (cell s i)) ->
    incl (cell_ids (same s) s i) (snd x)) as H.
  { induction n as [|n IH]; cbn zeta.
    - repeat split; cbn; auto using incl_refl. intros; lia.
    - change (Nat.iter (S n) f (0, l)) with (f (Nat.iter n f (0, l))).
      cbn zeta in IH. set (x := Nat.iter n f (0, l)) in *. destruct IH as (E & K & H).
      assert (snd (f x) = if existsb (fun v => member (same s v) l) (cell s (Z.of_nat n))
                          then union (fun v => v) (cell_ids (same s) s (Z.of_nat n)) (snd x) else snd x) as F.
      { rewrite <- E. reflexivity. }
      assert (incl (snd x) (snd (f x))) as S.
      { rewrite F. destruct (existsb _ _); [|apply incl_refl].
        intros v Hv. rewrite <- (map_id (union _ _ _)). apply union_keys. rewrite !map_id. auto. }
      split; [|split].
      + change (fst (f x)) with (fst x + 1). lia.
      + intros v Hv. apply S. auto.
      + intros i u Hi Hu Hc v Hv. destruct (Z.eq_dec i (Z.of_nat n)) as [->|N].
        * rewrite F. replace (existsb _ _) with true.
          { rewrite <- (map_id (union _ _ _)). apply union_keys. rewrite !map_id. auto. }
          symmetry. apply existsb_exists. apply in_map_iff in Hc as (a & <- & Ha).
          exists a. split; auto. now apply member_in.
        * apply S. apply (H i u); auto. lia. }
  destruct (H (Z.to_nat (ncell s))) as (_ & K & G). split; auto.
  intros u v Hu (i & Hi & U & V). apply (G i u); auto; [lia|]. now apply cell_ids_map.
Qed.

Lemma iter_inside {A} n (f : A -> A) x : Nat.iter (S n) f x = Nat.iter n f (f x).
Proof. induction n as [|n IH]; [easy|]. cbn in *. now rewrite IH. Qed.

Lemma repeatedly_grown s n : forall l u v, In u l -> within s n u v -> In v (Nat.iter n (grown s) l).
Proof.
  induction n as [|n IH]; intros l u v Hu W.
  - cbn in W. now subst.
  - rewrite iter_inside. destruct (grown_sound s l) as [K G]. destruct W as [->|(w & J & W)].
    + apply (IH _ v); [now apply K|apply within_refl].
    + apply (IH _ w); auto. now apply (G u).
Qed.

Lemma far_apart_sound s p q : far_apart s p q = true -> far_ids s p q.
Proof.
  intros H u v Hu Hv W. apply disjoint_sound in H. apply (H v); auto. now apply (repeatedly_grown s _ p u).
Qed.
Open Scope R_scope.

(** *** Means of points *)
Section Root.
Variable s : scene.
Variables l u d : Z.
Variable t : R.
Hypothesis d_positive : (0 < d)%Z.
Hypothesis t_inside : IZR l <= t * IZR d <= IZR u.
Hypothesis l_after : (tbeg s * d <= l)%Z.

Lemma segment_of_sound v p n : covers_time (tbeg s) (tend s) (path s v) ->
  segment_of l u d (path s v) = Some p ->
  0 < IZR (duration p) /\ eval (line n p) t = IZR (duration p) * dotR n (pos (path s v) t).
Proof.
  unfold segment_of. destruct (path s v) as [|(t0, p0) r]; [easy|]. intros (L & W & _).
  destruct (since_sound d l r d_positive t0 p0 W) as (t0' & p0' & r' & E & I & _ & P). rewrite E.
  apply IZR_lt in d_positive as D.
  assert (IZR t0 <= t) as T0.
  { apply (Rmult_le_reg_r (IZR d)); auto. apply Rle_trans with (IZR l); [|lra].
    rewrite <- mult_IZR. apply IZR_le. nia. }
  destruct (P t T0) as [T P']; [lra|]. cbn [pos]. rewrite P'. unfold line, duration.
  destruct r' as [|(t1, p1) r'].
  - destruct (u <=? t0' * d)%Z eqn:U; [|discriminate]. intros [= <-]. cbn [time0 time1 place0 place1].
    split; [apply IZR_lt; lia|]. to_R. cbn [eval pos_from]. rewrite <- dot_IZR.
    rewrite !minus_IZR, !mult_IZR, plus_IZR. ring.
  - destruct (u <=? t1 * d)%Z eqn:U; [|discriminate]. intros [= <-]. cbn [time0 time1 place0 place1].
    destruct I as [I _]. apply IZR_lt in I. rewrite minus_IZR. split; [lra|].
    apply Z.leb_le, IZR_le in U. rewrite mult_IZR in U.
    assert (t <= IZR t1) as T1 by (apply (Rmult_le_reg_r (IZR d)); lra).
    pose proof (far_segment n t0' p0' t1 p1 r' t I T1) as F. unfold far_from in F. rewrite F.
    cbn [eval]. rewrite !minus_IZR, !mult_IZR. field. lra.
Qed.

(** The vertices' points, and their weights as parts of [W]. *)
Definition points (vs : list (Z * poly)) : list pt := map (fun v => pos (path s v) t) (map fst vs).
Definition weights (W : R) (vs : list (Z * poly)) : list R := map (fun x => eval (snd x) t / W) vs.

(** The polynomials of a side at the root are those of the mean of its points. *)
Lemma side_of_sound W n vs : W <> 0 ->
  (forall x, In x vs -> covers_time (tbeg s) (tend s) (path s (fst x))) ->
  forall q, side_of s l u d vs = Some q ->
  0 < IZR (durations q) /\ eval (total q) t = sum (weights W vs) * W /\
  eval (moment n q) t = IZR (durations q) * W * dotR n (comb (weights W vs) (points vs)).
Proof.
  intros N. induction vs as [|(v, a) vs IH]; intros C q; cbn [side_of].
  - intros [= <-]. unfold dotR. cbn. repeat split; lra.
  - destruct (segment_of l u d (path s v)) as [p|] eqn:E; [|discriminate].
    destruct (side_of s l u d vs) as [r|]; [|discriminate]. intros [= <-].
    destruct (segment_of_sound v p n) as [D L]; auto; [apply (C (v, a)); now left|].
    destruct (IH (fun x I => C x (or_intror I)) r eq_refl) as (D' & T & M).
    cbn [durations total moment]. rewrite mult_IZR, !eval_add, !eval_scale, eval_mul, T, M, L.
    repeat split; [now apply Rmult_lt_0_compat| |]; unfold weights, points, dotR; cbn; field; auto.
Qed.

Lemma nonnegative_at_sound g p : eval g t = 0 -> nonnegative_at l u d g p = true -> 0 <= eval p t.
Proof.
  intros G. unfold nonnegative_at. rewrite orb_true_iff. intros [H|H].
  - rewrite (divides_sound g p t); auto. lra.
  - now apply (nonnegative_sound l u d).
Qed.

(** A side's point is in the simplex of its vertices. *)
Lemma side_ok_sound g i vs q : eval g t = 0 -> side_ok s l u d g i vs = true -> side_of s l u d vs = Some q ->
  positive_on l u d (total q) = true ->
  (0 <= i < ncell s)%Z /\ incl (map fst vs) (cell s i) /\ 0 < IZR (durations q) /\ 0 < eval (total q) t /\
  exists x, simplex s (map fst vs) t x /\
    forall n, eval (moment n q) t = IZR (durations q) * eval (total q) t * dotR n x.
Proof.
  intros G. unfold side_ok; rewrite !andb_true_iff, forallb_forall. intros [[L U] F] E T.
  apply Z.leb_le in L; apply Z.ltb_lt in U.
  assert (forall x, In x vs -> In (fst x) (cell s i) /\
          covers_time (tbeg s) (tend s) (path s (fst x)) /\ 0 <= eval (snd x) t) as A.
  { intros x Hx. apply F in Hx. rewrite !andb_true_iff in Hx. destruct Hx as [[X1 X2] X3].
    apply member_in in X1. apply wf_traj_sound in X2. apply nonnegative_at_sound in X3; auto. }
  apply (positive_sound l u d d_positive _ t) in T; auto. set (W := eval (total q) t) in *.
  assert (forall n, 0 < IZR (durations q) /\ W = sum (weights W vs) * W /\
          eval (moment n q) t = IZR (durations q) * W * dotR n (comb (weights W vs) (points vs))) as S.
  { intros n. apply side_of_sound; auto; [lra|]. intros x Hx. now apply A. }
  destruct (S (V3 0 0 0)) as (D & SW & _). repeat split; auto.
  - intros v Hv; apply in_map_iff in Hv as (x & <- & Hx). now apply A.
  - exists (comb (weights W vs) (points vs)). split; [|intros n; apply S].
    exists (weights W vs). repeat split.
    + unfold weights. now rewrite !map_length.
    + apply Forall_forall; intros a Ha. unfold weights in Ha. apply in_map_iff in Ha as (x & <- & Hx).
      apply Rmult_le_pos; [now apply A|]. now apply Rlt_le, Rinv_0_lt_compat.
    + apply (Rmult_eq_reg_r W); lra.
Qed.
End Root.

(** What the witness's checker accepts is true: the claim is false. *)
Theorem check_hit_sound strict s w : check_hit strict s w = true -> ~ never_touch strict s.
Proof.
  unfold check_hit. set (l := wl w). set (u := wu w). set (d := wd w). set (g := wg w). cbn zeta.
  rewrite !andb_true_iff. intros [[[[[[[[[[[_ D] T0] LU] T1] C] A] B] N] X] I] E] H.
  apply Z.ltb_lt in D. apply Z.leb_le in T0, LU, T1.
  destruct (changes_sign_sound l u d D g LU C) as (t & T & G).
  destruct (side_of s l u d (wp w)) as [p|] eqn:Ep; [|discriminate].
  destruct (side_of s l u d (wq w)) as [q|] eqn:Eq; [|discriminate].
  rewrite !andb_true_iff in E. destruct E as [[Pp Pq] E].
  destruct (side_ok_sound s l u d t D T T0 g _ _ p G A Ep Pp) as (Hi & IP & Dp & Wp & x & HP & Mp).
  destruct (side_ok_sound s l u d t D T T0 g _ _ q G B Eq Pq) as (Hj & IQ & Dq & Wq & y & HQ & Mq).
  set (k := IZR (durations p) * IZR (durations q) * (eval (total p) t * eval (total q) t)).
  assert (0 < k) as K by (unfold k; repeat apply Rmult_lt_0_compat; auto).
  assert (forall n, eval (difference n p q) t = k * (dotR n x - dotR n y)) as F.
  { intros n. unfold difference. rewrite eval_sub, !eval_scale, !eval_mul, Mp, Mq. unfold k. ring. }
  assert (dotR (V3 1 0 0) x = px x /\ dotR (V3 0 1 0) x = py x /\ dotR (V3 0 0 1) x = pz x) as (X1 & X2 & X3).
  { unfold dotR; cbn. repeat split; ring. }
  assert (dotR (V3 1 0 0) y = px y /\ dotR (V3 0 1 0) y = py y /\ dotR (V3 0 0 1) y = pz y) as (Y1 & Y2 & Y3).
  { unfold dotR; cbn. repeat split; ring. }
  apply IZR_lt in D as D'.
  assert (IZR (tbeg s) <= t <= IZR (tend s)) as Ht.
  { apply IZR_le in T0, T1. rewrite mult_IZR in T0, T1. split; apply (Rmult_le_reg_r (IZR d)); lra. }
  destruct (H t Ht (wi w) (wj w) Hi Hj) with (P := map fst (wp w)) (Q := map fst (wq w)) (x := x) (y := y)
    as [H1 H2]; auto.
  - apply orb_true_iff in N as [N|N]; [now left|]. right. now apply negb_true_iff, Z.eqb_neq in N.
  - intros Y. apply excluded_pair_complete in Y. rewrite Y in X. discriminate.
  - rewrite !map_map in H1, H2. apply orb_true_iff in E as [E|E].
    + apply disjoint_sound in I. specialize (H1 I). clear H2.
      assert (forall n, divides g (difference n p q) = true -> dotR n x = dotR n y) as Z0.
      { intros n V. apply (divides_sound _ _ t) in V; auto. rewrite F in V.
        apply Rmult_integral in V as [V|V]; lra. }
      unfold meet in E. rewrite !andb_true_iff in E. destruct E as [[E1 E2] E3].
      apply Z0 in E1, E2, E3. rewrite X1, Y1 in E1. rewrite X2, Y2 in E2. rewrite X3, Y3 in E3.
      unfold dist2 in H1. rewrite E1, E2, E3 in H1. lra.
    + rewrite !andb_true_iff in E. destruct E as [[_ E1] E2].
      apply far_apart_sound in E1. specialize (H2 E1). clear H1.
      apply (nonnegative_at_sound l u d t D T g) in E2; auto. unfold nearness in E2.
      rewrite eval_sub, !eval_add, !eval_mul, eval_scale, eval_mul, !F, !mult_IZR in E2.
      rewrite X1, X2, X3, Y1, Y2, Y3 in E2.
      assert (0 <= k * k * (IZR (eta s) ^ 2 - dist2 x y)) as L.
      { unfold dist2. unfold k in *. lra. }
      assert (0 < k * k * (dist2 x y - IZR (eta s) ^ 2)); [|lra].
      apply Rmult_lt_0_compat; [now apply Rmult_lt_0_compat|lra].
Qed.

(** A witness of two different cells refutes the strict claim as well. *)
Corollary check_hit_sound_both s w : check_hit false s w = true -> forall strict, ~ never_touch strict s.
Proof.
  intros H [|] N; apply (check_hit_sound false s w H); auto. now apply never_touch_weaken.
Qed.
