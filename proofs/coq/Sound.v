(* SPDX-License-Identifier: Apache-2.0 *)
(** * The checker is right: what it accepts never touches

    The theorems: [check_sound] and [check_well_formed], at the end, and for streams
    [run_app].  The way there: a trajectory from a time on, and the search for it (1), half
    spaces (2), directions (3), hulls (4), obligations, and what is near (5), one token (6),
    the tree over the cells, and the vertices in it (7).

    Notation: [t] is a real time; [D] is the real number of the denominator [d], so
    that [a/d <= t] is written [IZR a <= t * D]; [f] and [g] are real functions of
    time, [cs] times with denominator [d], [us] and [vs] values at these times.

    Not here: that every scene without contact has a proof that is accepted. *)
Require Import ZArith List Bool Reals Lra Lia Psatz.
From Noli Require Import Spec Checker.
Import ListNotations.

(** Turns what the checker computed into statements about real numbers. *)
Ltac to_R := repeat match goal with
  | H : (_ <? _)%Z = true |- _ => apply Z.ltb_lt, IZR_lt in H
  | H : (_ <? _)%Z = false |- _ => apply Z.ltb_ge, IZR_le in H
  | H : (_ <=? _)%Z = true |- _ => apply Z.leb_le, IZR_le in H
  | H : (_ <=? _)%Z = false |- _ => apply Z.leb_gt, IZR_lt in H
  | H : (_ && _)%bool = true |- _ => apply andb_true_iff in H; destruct H
  | H : (_ < _)%Z |- _ => apply IZR_lt in H
  | H : (_ <= _)%Z |- _ => apply IZR_le in H
  end; rewrite ?plus_IZR, ?mult_IZR, ?plus_IZR, ?minus_IZR in *.

Open Scope R_scope.

(** ** 1. Trajectories *)

Lemma mix_0 p q : mix 0 p q = p.
Proof. destruct p, q; unfold mix; cbn; f_equal; ring. Qed.
Lemma mix_1 p q : mix 1 p q = q.
Proof. destruct p, q; unfold mix; cbn; f_equal; ring. Qed.

(** A trajectory is at its first breakpoint at that breakpoint's time. *)
Lemma pos_from_start t0 p0 r : increasing t0 r -> pos_from t0 p0 r (IZR t0) = inj p0.
Proof.
  destruct r as [|(t1, p1) r]; cbn; auto. intros [W _]; to_R.
  destruct (Rle_dec _ _); [|lra].
  replace (_ / _) with 0 by (field; lra). apply mix_0.
Qed.

(** From the second breakpoint on, the first may be forgotten. *)
Lemma pos_from_next t0 p0 t1 p1 r t : increasing t0 ((t1, p1) :: r) -> IZR t1 <= t ->
  pos_from t0 p0 ((t1, p1) :: r) t = pos_from t1 p1 r t.
Proof.
  cbn; intros [L W] H; to_R. destruct (Rle_dec _ _); auto.
  assert (t = IZR t1) as -> by lra. rewrite pos_from_start by auto.
  replace (_ / _) with 1 by (field; lra). apply mix_1.
Qed.

(** [reaches] says of integers what [increasing] and [last_time] say. *)
Lemma reaches_sound T r : forall t0, reaches t0 T r = true ->
  increasing t0 r /\ (T <= last_time t0 r)%Z.
Proof.
  induction r as [|(t1, p1) r IH]; cbn; intros t0 H.
  - split; auto. now apply Z.leb_le.
  - apply andb_true_iff in H as [L H]. apply Z.ltb_lt in L. destruct (IH _ H); auto.
Qed.

Lemma wf_traj_sound T0 T1 tr : wf_traj T0 T1 tr = true -> covers_time T0 T1 tr.
Proof.
  destruct tr as [|(t0, p0) r]; cbn; [discriminate|]. intros H.
  apply andb_true_iff in H as [L H]. apply Z.leb_le in L.
  apply reaches_sound in H. tauto.
Qed.

(** From a breakpoint on, all breakpoints before may be forgotten. *)
Lemma pos_from_later l r T p t : forall t0 p0, increasing t0 (l ++ (T, p) :: r) -> IZR T <= t ->
  pos_from t0 p0 (l ++ (T, p) :: r) t = pos_from T p r t.
Proof.
  induction l as [|(t1, p1) l IH]; intros t0 p0 W H.
  - now apply pos_from_next.
  - cbn [app] in *. rewrite pos_from_next; auto.
    + apply IH; auto. apply W.
    + apply Rle_trans with (IZR T); auto. apply IZR_le. clear - W. destruct W as [_ W].
      revert t1 W. induction l as [|(t2, p2) l IH]; cbn; intros t1 W; [lia|].
      destruct W as [L W]. apply IH in W. lia.
Qed.

(** A breakpoint inside a trajectory is later than the first, and so are those after it. *)
Lemma increasing_later l T p r : forall t0, increasing t0 (l ++ (T, p) :: r) -> (t0 < T)%Z /\ increasing T r.
Proof. induction l as [|(t1, p1) l IH]; cbn; intros t0 [L W]; auto. apply IH in W. intuition lia. Qed.

(** *** Search trees *)

(** All things of a search tree are [P]. *)
Fixpoint each {A} (P : A -> Prop) (x : search A) : Prop :=
  match x with
  | Found a => P a
  | Choose _ l r => each P l /\ each P r
  end.

Fixpoint first {A} (x : search A) : A :=
  match x with
  | Found a => a
  | Choose _ l _ => first l
  end.

(** The keys are those of the first things on their right. *)
Fixpoint keyed {A} (key : A -> Z) (x : search A) : Prop :=
  match x with
  | Found _ => True
  | Choose k l r => key (first r) = k /\ keyed key l /\ keyed key r
  end.

Lemma find_each {A} (P : A -> Prop) low x : each P x -> P (find low x).
Proof. induction x as [|k l IHl r IHr]; cbn; auto. destruct (low k); tauto. Qed.

(** What is found is the first, or its key is [low]. *)
Lemma find_low {A} (key : A -> Z) low x : keyed key x ->
  find low x = first x \/ low (key (find low x)) = true.
Proof.
  induction x as [a|k l IHl r IHr]; cbn; auto. intros (K & L & R).
  destruct (low k) eqn:E; auto. right. destruct (IHr R) as [->|]; auto. now rewrite K.
Qed.

(** What [join_all] keeps of each tree in its list. *)
Definition sorted_in {A} (P : A -> Prop) (key : A -> Z) (kx : Z * search A) : Prop :=
  each P (snd kx) /\ keyed key (snd kx) /\ key (first (snd kx)) = fst kx.

Lemma join_pairs_sound {A} (P : A -> Prop) key n : forall l acc, (length l <= n)%nat ->
  Forall (sorted_in P key) l ->
  exists l', join_pairs l acc = rev_append acc l' /\ Forall (sorted_in P key) l' /\
    forall k x r, l = (k, x) :: r -> exists k' x' r', l' = (k', x') :: r' /\ first x' = first x.
Proof.
  induction n as [|n IH]; intros l acc L F.
  - destruct l; cbn in L; [|lia]. exists []. cbn. repeat split; auto. discriminate.
  - destruct l as [|(k1, x1) [|(k2, x2) r]].
    + exists []. cbn. repeat split; auto. discriminate.
    + exists [(k1, x1)]. cbn. repeat split; auto. intros k x r [= <- <- <-]. eauto.
    + inversion F as [|? ? (E1 & K1 & H1) F1]; inversion F1 as [|? ? (E2 & K2 & H2) F2]; subst. cbn in *.
      destruct (IH r ((k1, Choose k2 x1 x2) :: acc)) as (l' & E & F' & _); [lia|auto|].
      exists ((k1, Choose k2 x1 x2) :: l'). repeat split.
      * exact E.
      * constructor; auto. unfold sorted_in; cbn; auto.
      * intros k x r' [= <- <- <-]. exists k1, (Choose k2 x1 x2), l'. auto.
Qed.

Lemma join_all_sound {A B} (P : A -> Prop) key (fuel : list B) : forall l x,
  Forall (sorted_in P key) l -> join_all fuel l = Some x ->
  each P x /\ keyed key x /\ exists k x' r, l = (k, x') :: r /\ first x = first x'.
Proof.
  induction fuel as [|b fuel IH]; intros [|(k1, x1) r] x F; cbn [join_all]; try discriminate.
  - apply Forall_inv in F as (E & K & _). cbn in *.
    destruct r; intros [= <-]; repeat split; auto; do 3 eexists; eauto.
  - destruct r as [|(k2, x2) r].
    + apply Forall_inv in F as (E & K & _). intros [= <-]. repeat split; auto. do 3 eexists; eauto.
    + intros H.
      destruct (join_pairs_sound P key _ _ [] (le_n _) F) as (l' & E & F' & H').
      rewrite E in H. cbn [rev_append] in H. destruct (IH l' x F' H) as (X1 & X2 & (k & x' & r' & E' & Fx)).
      destruct (H' _ _ _ eq_refl) as (k3 & x3 & r3 & E3 & Fx3).
      repeat split; auto. exists k1, x1, ((k2, x2) :: r). split; auto. congruence.
Qed.

(** *** The search tree of a trajectory *)

Definition suffix_of (tr l : traj) : Prop := l <> [] /\ exists l', tr = l' ++ l.
Definition time_of (tr : traj) : Z := match tr with [] => 0 | (t, _) :: _ => t end.

Lemma suffixes_sound tr tr' : forall l acc, tr = l ++ tr' ->
  Forall (sorted_in (suffix_of tr) time_of) acc ->
  Forall (sorted_in (suffix_of tr) time_of) (suffixes tr' acc).
Proof.
  induction tr' as [|(t, p) r IH]; cbn [suffixes]; intros l acc E F.
  - rewrite rev_append_rev, app_nil_r. now apply Forall_rev.
  - apply (IH (l ++ [(t, p)])); [now rewrite <- app_assoc|]. constructor; auto.
    repeat split; eauto. discriminate.
Qed.

Lemma suffixes_acc tr : forall acc, suffixes tr acc = rev_append acc (suffixes tr []).
Proof.
  induction tr as [|(t, p) r IH]; intros acc; cbn [suffixes]; auto. rewrite IH, (IH [_]). reflexivity.
Qed.

Lemma index_sound tr : tr <> [] ->
  each (suffix_of tr) (index tr) /\ keyed time_of (index tr) /\ first (index tr) = tr.
Proof.
  intros N. unfold index. destruct (join_all tr (suffixes tr [])) as [x|] eqn:E.
  - apply (join_all_sound (suffix_of tr) time_of) in E as (E & K & (k & x' & r & L & F)).
    + repeat split; auto. rewrite F. destruct tr as [|(t, p) tr]; [easy|].
      cbn [suffixes] in L. rewrite suffixes_acc in L. cbn in L. now injection L as <- <- <-.
    + apply (suffixes_sound tr tr []); auto.
  - cbn. repeat split; auto. now exists [].
Qed.

(** [equal_traj] is equality. *)
Lemma equal_traj_sound tr1 : forall tr2, equal_traj tr1 tr2 = true -> tr1 = tr2.
Proof.
  induction tr1 as [|(t1, (x1, y1, z1)) r1 IH]; destruct tr2 as [|(t2, (x2, y2, z2)) r2]; cbn; try easy.
  destruct (_ && _)%bool eqn:E; [|discriminate]. rewrite !andb_true_iff, !Z.eqb_eq in E.
  destruct E as [[[-> ->] ->] ->]. intros H. f_equal. auto.
Qed.

(** [since] leaves a trajectory the same, from [a/d] on. *)
Lemma since_sound d a r : (0 < d)%Z -> forall t0 p0, increasing t0 r ->
  exists t0' p0' r', since d a (index ((t0, p0) :: r)) = (t0', p0') :: r' /\
    increasing t0' r' /\ IZR t0 <= IZR t0' /\
    forall t, IZR t0 <= t -> IZR a <= t * IZR d ->
      IZR t0' <= t /\ pos_from t0 p0 r t = pos_from t0' p0' r' t.
Proof.
  intros D t0 p0 W. set (tr := (t0, p0) :: r).
  destruct (index_sound tr) as (E & K & F); [discriminate|].
  apply (find_each _ (fun t => t * d <=? a)%Z) in E as [N (l & E)].
  apply (find_low _ (fun t => t * d <=? a)%Z) in K. fold (since d a (index tr)) in *. rewrite F in K.
  destruct (since d a (index tr)) as [|(t1, p1) r1]; [easy|].
  exists t1, p1, r1. destruct l as [|b l].
  - injection E as <- <- <-. repeat split; auto; lra.
  - destruct K as [K|K].
    + exfalso. apply (f_equal (@length _)) in E. rewrite <- K, app_length in E. cbn in E. lia.
    + unfold tr in E. injection E as <- ->. apply increasing_later in W as W'. destruct W' as [L I].
      apply IZR_lt in L, D. repeat split; auto; [lra| |]; cbn in K; to_R; assert (IZR t1 <= t) by nra; auto.
      now apply pos_from_later.
Qed.

(** ** 2. P: half spaces *)

Definition dotR (n : vec) (p : pt) : R := IZR (vx n) * px p + IZR (vy n) * py p + IZR (vz n) * pz p.

Definition valueR (h : halfspace) (t : R) (p : pt) : R := dotR (normal h) p + IZR (nt h) * t - IZR (nd h).

Lemma dot_IZR n p : IZR (dot n p) = dotR n (inj p).
Proof. unfold dot, dotR, inj; cbn. now rewrite !plus_IZR, !mult_IZR. Qed.

Lemma value_IZR h t p : IZR (value h t p) = valueR h (IZR t) (inj p).
Proof. unfold value, valueR. now rewrite minus_IZR, plus_IZR, mult_IZR, dot_IZR. Qed.

Lemma valueR_behind h w t p : valueR (behind h w) t p = - valueR h t p - IZR w.
Proof. unfold valueR, dotR, behind, opposite; cbn; rewrite minus_IZR, !opp_IZR; ring. Qed.

(** What is linear and positive at two times is positive between them. *)
Lemma linear_positive u v lo hi t :
  lo <= t <= hi -> 0 < u + v * lo -> 0 < u + v * hi -> 0 < u + v * t.
Proof. intros; destruct (Rle_dec 0 v); nra. Qed.

(** On a segment, a half space's value is interpolated between its ends. *)
Lemma segment_value h (t0 t1 : R) p0 p1 t : t0 < t1 ->
  (t1 - t0) * valueR h t (mix ((t - t0) / (t1 - t0)) p0 p1)
  = valueR h t0 p0 * (t1 - t) + valueR h t1 p1 * (t - t0).
Proof. intros; unfold valueR, dotR, mix; cbn; field; lra. Qed.

(** [c] is a time with the denominator of [a], [b], [s0] and [s1]. *)
Lemma segment_positive_sound a b s0 s1 g0 g1 c :
  segment_positive a b s0 g0 s1 g1 = true ->
  IZR s0 < IZR s1 -> IZR a <= c <= IZR b -> IZR s0 <= c <= IZR s1 ->
  0 < IZR g0 * (IZR s1 - c) + IZR g1 * (c - IZR s0).
Proof.
  unfold segment_positive; intros H H01 Hab Ht.
  set (u := IZR g0 * IZR s1 - IZR g1 * IZR s0).
  set (v := IZR g1 - IZR g0).
  replace (_ + _) with (u + v * c) by (unfold u, v; ring).
  apply andb_true_iff in H; destruct H as [L U].
  assert (exists lo, lo <= c /\ 0 < u + v * lo) as (lo & Hlo & Plo).
  { destruct (a <=? s0)%Z eqn:E; to_R.
    - exists (IZR s0); split; [lra|].
      replace (u + _) with (IZR g0 * (IZR s1 - IZR s0)) by (unfold u, v; ring).
      apply Rmult_lt_0_compat; lra.
    - exists (IZR a); split; [lra|]. unfold u, v; lra. }
  assert (exists hi, c <= hi /\ 0 < u + v * hi) as (hi & Hhi & Phi).
  { destruct (s1 <=? b)%Z eqn:E; to_R.
    - exists (IZR s1); split; [lra|].
      replace (u + _) with (IZR g1 * (IZR s1 - IZR s0)) by (unfold u, v; ring).
      apply Rmult_lt_0_compat; lra.
    - exists (IZR b); split; [lra|]. unfold u, v; lra. }
  apply (linear_positive u v lo hi c); auto.
Qed.

Lemma inside_from_sound h a b d r : (0 < d)%Z -> forall t0 p0,
  increasing t0 r -> inside_from h a b d t0 (value h t0 p0) r = true ->
  forall t, IZR a <= t * IZR d <= IZR b -> IZR t0 <= t ->
  0 < valueR h t (pos_from t0 p0 r t).
Proof.
  intros D; induction r as [|(t1, p1) r IH]; intros t0 p0 W A t Hab Ht; [discriminate|].
  cbn [inside_from] in A. destruct (segment_positive _ _ _ _ _ _) eqn:S; [|discriminate].
  pose proof (IZR_lt _ _ (proj1 W)) as L. apply IZR_lt in D as D'.
  destruct (Rle_dec t (IZR t1)) as [T|T].
  - cbn [pos_from]. destruct (Rle_dec t (IZR t1)) as [_|]; [|contradiction].
    apply segment_positive_sound with (c := t * IZR d) in S; rewrite ?mult_IZR in *;
      [|apply Rmult_lt_compat_r; lra|lra|split; apply Rmult_le_compat_r; lra].
    rewrite !value_IZR in S.
    apply Rmult_lt_reg_l with ((IZR t1 - IZR t0) * IZR d); [nra|].
    rewrite Rmult_0_r, (Rmult_comm _ (IZR d)), Rmult_assoc, segment_value by lra.
    lra.
  - rewrite pos_from_next by (auto; lra). destruct (b <=? t1 * d)%Z eqn:B; to_R; [nra|].
    apply IH; auto; [apply W|lra].
Qed.

Lemma inside_sound h a b d T0 T1 tr t : (0 < d)%Z ->
  covers_time T0 T1 tr -> inside h a b d (index tr) = true ->
  IZR a <= t * IZR d <= IZR b -> IZR T0 <= t ->
  0 < valueR h t (pos tr t).
Proof.
  destruct tr as [|(t0, p0) r]; [easy|]. intros D (L & W & _) A Hab Ht.
  destruct (since_sound d a r D t0 p0 W) as (t0' & p0' & r' & E & I & _ & P). apply IZR_le in L.
  unfold inside in A. rewrite E in A. cbn [pos].
  destruct (P t) as [Q ->]; try lra. now apply inside_from_sound with a b d.
Qed.

(** ** 3. S: directions *)

(** The real number that a rational is. *)
Definition ratR (q : rat) : R := IZR (fst q) / IZR (snd q).
Definition proper (q : rat) : Prop := (0 < snd q)%Z.

Lemma div_lt x y a b : 0 < a -> 0 < b -> (x / a < y / b <-> x * b < y * a).
Proof.
  intros A B. replace (x / a) with (x * b * / (a * b)) by (field; lra).
  replace (y / b) with (y * a * / (a * b)) by (field; lra).
  pose proof (Rinv_0_lt_compat _ (Rmult_lt_0_compat _ _ A B)) as I.
  split; intros H; [now apply Rmult_lt_reg_r in H|now apply Rmult_lt_compat_r].
Qed.

Lemma rat_lt_sound q r : proper q -> proper r -> (rat_lt q r = true <-> ratR q < ratR r).
Proof.
  unfold proper, rat_lt, ratR; intros Q P. apply IZR_lt in Q as Q', P as P'.
  rewrite div_lt by auto. destruct (snd q =? snd r)%Z eqn:E.
  - apply Z.eqb_eq in E. rewrite E in *. rewrite Z.ltb_lt. split; intros H.
    + apply Rmult_lt_compat_r; auto. now apply IZR_lt.
    + apply Rmult_lt_reg_r in H; auto. now apply lt_IZR.
  - rewrite Z.ltb_lt, <- !mult_IZR. split; [apply IZR_lt|apply lt_IZR].
Qed.

(** [m] is not negative, and at most the root of [k]: this avoids the root itself. *)
Definition below_root (k : Z) (m : R) : Prop := 0 <= m /\ m * m <= IZR k.

Lemma less_by_squares m g : 0 < g -> m * m < g * g -> m < g.
Proof.
  intros G H. apply Rnot_le_lt. intros L.
  assert (g * g <= m * m) by (apply Rmult_le_compat; lra). lra.
Qed.

Lemma rat_over_sound k m q r : below_root k m -> proper q -> proper r ->
  rat_over k q r = true -> ratR q + m < ratR r.
Proof.
  intros [M K] Q P. unfold rat_over. destruct (rat_lt q r) eqn:L; [|discriminate].
  apply rat_lt_sound in L; auto. destruct (Z.eqb_spec k 0) as [->|_].
  - intros _. assert (m = 0) as -> by nra. lra.
  - cbn zeta. intros H. apply Z.ltb_lt, IZR_lt in H.
    repeat (rewrite mult_IZR in H || rewrite minus_IZR in H).
    assert (m < ratR r - ratR q); [|lra]. apply less_by_squares; [lra|].
    apply Rle_lt_trans with (1 := K).
    unfold proper, ratR in *. apply IZR_lt in Q, P.
    set (a := IZR (fst q)) in *. set (b := IZR (snd q)) in *.
    set (c := IZR (fst r)) in *. set (e := IZR (snd r)) in *.
    replace (c / e - a / b) with ((c * b - a * e) / (b * e)) by (field; lra).
    assert (0 < b * e) as BE by (apply Rmult_lt_0_compat; auto).
    apply Rmult_lt_reg_r with ((b * e) * (b * e)); [apply Rmult_lt_0_compat; auto|].
    match goal with |- _ < ?r => replace r with ((c * b - a * e) * (c * b - a * e)) by (field; lra) end. lra.
Qed.

Lemma rat_min_sound q r : proper q -> proper r ->
  proper (rat_min q r) /\ ratR (rat_min q r) <= ratR q /\ ratR (rat_min q r) <= ratR r.
Proof.
  intros Q P. unfold rat_min. pose proof (rat_lt_sound q r Q P) as H.
  destruct (rat_lt q r).
  - assert (ratR q < ratR r) by now apply H. repeat split; auto; lra.
  - assert (~ ratR q < ratR r) by (intros N; apply H in N; discriminate). repeat split; auto; lra.
Qed.

(** [f] is interpolated between its values at [c/d] and [c'/d]. *)
Definition linear (f : R -> R) (d c c' : Z) : Prop :=
  forall t, IZR c <= t * IZR d <= IZR c' ->
  let u := (t * IZR d - IZR c) / (IZR c' - IZR c) in
  f t = (1 - u) * f (IZR c / IZR d) + u * f (IZR c' / IZR d).

(** [f] is linear between the times c0 and [cs], which are in order, and [us] are
    its values at [cs]. *)
Fixpoint knots (f : R -> R) (d c0 : Z) (cs : list Z) (us : list rat) : Prop :=
  match cs, us with
  | [], [] => True
  | c :: cs', q :: us' =>
      IZR c0 <= IZR c /\ linear f d c0 c /\ proper q /\ ratR q = f (IZR c / IZR d) /\ knots f d c cs' us'
  | _, _ => False
  end.

Fixpoint final (c0 : Z) (cs : list Z) : Z :=
  match cs with [] => c0 | c :: cs' => final c cs' end.

Lemma knots_length f d cs : forall c0 us, knots f d c0 cs us -> length us = length cs.
Proof.
  induction cs as [|c cs IH]; destruct us; cbn; try easy.
  intros (_ & _ & _ & _ & K). f_equal. eapply IH; eauto.
Qed.

Lemma knots_proper f d cs : forall c0 us, knots f d c0 cs us -> Forall proper us.
Proof.
  induction cs as [|c cs IH]; destruct us; cbn; try easy.
  intros (_ & _ & P & _ & K). constructor; eauto.
Qed.

Lemma linear_ext f g d c c' : (0 < d)%Z -> IZR c <= IZR c' ->
  (forall t, IZR c <= t * IZR d -> f t = g t) -> linear g d c c' -> linear f d c c'.
Proof.
  intros D L E H t T u. apply IZR_lt in D. rewrite !E; [now apply H| | |lra].
  - replace (_ * _) with (IZR c') by (field; lra). lra.
  - replace (_ * _) with (IZR c) by (field; lra). lra.
Qed.

Lemma knots_ext f g d : (0 < d)%Z -> forall cs c0 us,
  (forall t, IZR c0 <= t * IZR d -> f t = g t) -> knots g d c0 cs us -> knots f d c0 cs us.
Proof.
  intros D; induction cs as [|c cs IH]; destruct us; cbn; try easy.
  intros E (L & N & P & V & K). repeat split; auto.
  - eapply linear_ext; eauto.
  - rewrite V, E; auto. apply IZR_lt in D. replace (_ * _) with (IZR c) by (field; lra). lra.
  - apply IH; auto. intros; apply E; lra.
Qed.

(** Two functions compare at all times as they do at the knots of both. *)
Lemma knots_less m f g d : (0 < d)%Z -> forall cs c0 us vs,
  knots f d c0 cs us -> knots g d c0 cs vs -> Forall2 (fun q r => ratR q + m < ratR r) us vs ->
  f (IZR c0 / IZR d) + m < g (IZR c0 / IZR d) ->
  forall t, IZR c0 <= t * IZR d <= IZR (final c0 cs) -> f t + m < g t.
Proof.
  intros D; apply IZR_lt in D as D'. induction cs as [|c cs IH]; intros c0 us vs F G A H0 t Ht.
  - cbn in Ht. replace (IZR c0 / IZR d) with t in H0; auto.
    replace (IZR c0) with (t * IZR d) by lra. field; lra.
  - destruct us as [|q us], vs as [|r vs]; try easy. cbn in F, G, Ht.
    destruct F as (L & Nf & _ & Ef & Kf), G as (_ & Ng & _ & Eg & Kg).
    inversion A as [|? ? ? ? H1 A']; subst. rewrite Ef, Eg in H1.
    destruct (Rle_dec (t * IZR d) (IZR c)) as [T|T].
    + rewrite (Nf t), (Ng t) by lra. set (u := _ / _).
      destruct (Req_dec (IZR c0) (IZR c)) as [E|E].
      * rewrite E in H0 |- *. set (y := f _) in *. set (z := g _) in *.
        replace ((1 - u) * y + u * y) with y by ring. replace ((1 - u) * z + u * z) with z by ring. auto.
      * assert (0 <= u) by (apply Rmult_le_pos; [lra|]; apply Rlt_le, Rinv_0_lt_compat; lra).
        assert (u <= 1).
        { apply (Rmult_le_reg_r (IZR c - IZR c0)); [lra|].
          unfold u, Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
        destruct (Req_dec u 0) as [->|]; [lra|].
        assert (0 <= (1 - u) * (g (IZR c0 / IZR d) - f (IZR c0 / IZR d) - m)) by (apply Rmult_le_pos; lra).
        assert (0 < u * (g (IZR c / IZR d) - f (IZR c / IZR d) - m)) by (apply Rmult_lt_0_compat; lra). lra.
    + apply (IH c us vs); auto; lra.
Qed.

(** How far a trajectory is in direction [n]. *)
Definition far_from (n : vec) (t0 : Z) (p0 : vec) (r : traj) (t : R) : R := dotR n (pos_from t0 p0 r t).

Lemma far_segment n t0 p0 t1 p1 r t : IZR t0 < IZR t1 -> t <= IZR t1 ->
  far_from n t0 p0 ((t1, p1) :: r) t =
  (IZR (dot n p0) * (IZR t1 - t) + IZR (dot n p1) * (t - IZR t0)) / (IZR t1 - IZR t0).
Proof.
  intros L T. unfold far_from; cbn [pos_from]. destruct (Rle_dec _ _) as [_|]; [|contradiction].
  rewrite !dot_IZR. unfold dotR, mix; cbn. field; lra.
Qed.

Lemma far_linear n t0 p0 t1 p1 r d c c' : (0 < d)%Z -> IZR t0 < IZR t1 ->
  IZR c <= IZR c' <= IZR (t1 * d) -> linear (far_from n t0 p0 ((t1, p1) :: r)) d c c'.
Proof.
  intros D L H t T u. apply IZR_lt in D. rewrite mult_IZR in H.
  assert (forall x, x * IZR d <= IZR t1 * IZR d -> x <= IZR t1) as S.
  { intros x Hx. now apply Rmult_le_reg_r in Hx. }
  rewrite !far_segment; auto.
  - destruct (Req_dec (IZR c) (IZR c')) as [E|E].
    + replace (IZR c' / IZR d) with t.
      * replace (IZR c / IZR d) with t; [field; lra|].
        replace (IZR c) with (t * IZR d) by lra. field; lra.
      * replace (IZR c') with (t * IZR d) by lra. field; lra.
    + unfold u. field. lra.
  - apply S. replace (_ * _) with (IZR c') by (field; lra). lra.
  - apply S. replace (_ * _) with (IZR c) by (field; lra). lra.
  - apply S. lra.
Qed.

Lemma between_sound n t0 p0 t1 p1 r d c : (0 < d)%Z -> IZR t0 < IZR t1 ->
  IZR c <= IZR (t1 * d) ->
  let q := between (t0 * d) (dot n p0) (t1 * d) (dot n p1) c in
  proper q /\ ratR q = far_from n t0 p0 ((t1, p1) :: r) (IZR c / IZR d).
Proof.
  intros D L H. apply IZR_lt in D as D'. rewrite mult_IZR in H.
  rewrite far_segment; auto; [|apply (Rmult_le_reg_r (IZR d)); auto; unfold Rdiv;
                               rewrite Rmult_assoc, Rinv_l; lra].
  unfold between, ratR, proper. destruct (c =? t0 * d)%Z eqn:E0; [|destruct (c =? t1 * d)%Z eqn:E1];
    cbn [fst snd]; repeat split; try lia.
  - apply Z.eqb_eq in E0 as ->. rewrite mult_IZR. field; lra.
  - apply Z.eqb_eq in E1 as ->. rewrite mult_IZR. field; lra.
  - apply lt_IZR in L. nia.
  - rewrite plus_IZR, !mult_IZR, !minus_IZR, !mult_IZR. field. nra.
Qed.

Lemma along_cons n b d t0 g0 t1 p1 r c' c cs acc :
  along n b d t0 g0 ((t1, p1) :: r) c' (c :: cs) acc =
  if (c <? c')%Z then None
  else if (c <=? t1 * d)%Z
  then along n b d t0 g0 ((t1, p1) :: r) c cs (between (t0 * d) g0 (t1 * d) (dot n p1) c :: acc)
  else if (t1 * d <=? c')%Z then along n b d t1 (dot n p1) r c' (c :: cs) acc else None.
Proof. reflexivity. Qed.

Lemma along_sound n b d r : (0 < d)%Z -> forall cs t0 p0 c' acc us,
  increasing t0 r -> along n b d t0 (dot n p0) r c' cs acc = Some us ->
  exists vs, us = rev_append acc vs /\ IZR b <= IZR (final c' cs) /\
             knots (far_from n t0 p0 r) d c' cs vs.
Proof.
  intros D. induction r as [|(t1, p1) r IHr]; [discriminate|].
  induction cs as [|c cs IHc]; intros t0 p0 c' acc us W A.
  - cbn in A. destruct (b <=? c')%Z eqn:B; [|discriminate]. injection A as <-.
    exists []. cbn. to_R. repeat split; auto.
  - rewrite along_cons in A. destruct (c <? c')%Z eqn:E0; [discriminate|].
    pose proof (IZR_lt _ _ (proj1 W)) as L. apply Z.ltb_ge, IZR_le in E0.
    destruct (c <=? t1 * d)%Z eqn:E1.
    + apply Z.leb_le, IZR_le in E1.
      apply IHc in A as (vs & -> & B & K); auto.
      destruct (between_sound n t0 p0 t1 p1 r d c D L E1) as [P V].
      exists (between (t0 * d) (dot n p0) (t1 * d) (dot n p1) c :: vs). repeat split; auto.
      now apply far_linear.
    + destruct (t1 * d <=? c')%Z eqn:E2; [|discriminate].
      apply IHr in A as (vs & -> & B & K); [|apply W]. exists vs. repeat split; auto.
      eapply knots_ext; [auto| |apply K]. intros t T. unfold far_from.
      rewrite pos_from_next; auto. apply IZR_lt in D. to_R. nra.
Qed.

Definition far (n : vec) (tr : traj) (t : R) : R := dotR n (pos tr t).

Lemma values_sound n a b d cs T0 T1 tr us : (0 < d)%Z -> covers_time T0 T1 tr ->
  values n a b d cs (index tr) = Some us ->
  knots (far n tr) d a cs us /\ IZR b <= IZR (final a cs).
Proof.
  destruct tr as [|(t0, p0) r]; [easy|]. intros D (_ & W & _) A.
  destruct (since_sound d a r D t0 p0 W) as (t0' & p0' & r' & E & I & L & P).
  unfold values in A. rewrite E in A. destruct (t0' * d <=? a)%Z eqn:E0; [|discriminate].
  apply along_sound in A as (vs & -> & B & K); auto. split; auto. cbn [rev_append].
  eapply knots_ext; [auto| |apply K]. intros t T. unfold far, far_from. cbn [pos].
  destruct (P t) as [_ ->]; auto. apply IZR_lt in D. to_R. nra.
Qed.

Lemma lower_acc_length l1 : forall l2 acc, length l2 = length l1 ->
  length (lower_acc l1 l2 acc) = (length acc + length l1)%nat.
Proof.
  induction l1 as [|q l1 IH]; destruct l2 as [|r l2]; cbn; intros acc E; try easy.
  - rewrite rev_append_rev, app_length, rev_length; cbn; lia.
  - rewrite IH by lia. cbn; lia.
Qed.

Definition rat_le (q r : rat) : Prop := ratR q <= ratR r.

Lemma lower_acc_eq l1 : forall l2 acc, lower_acc l1 l2 acc = rev_append acc (lower_acc l1 l2 []).
Proof.
  induction l1 as [|q l1 IH]; destruct l2 as [|r l2]; cbn; intros acc; auto.
  rewrite IH, (IH l2 [_]). reflexivity.
Qed.

Lemma lower_sound l1 : forall l2, length l1 = length l2 -> Forall proper l1 -> Forall proper l2 ->
  let l := lower_acc l1 l2 [] in
  Forall proper l /\ Forall2 rat_le l l1 /\ Forall2 rat_le l l2.
Proof.
  induction l1 as [|q l1 IH]; destruct l2 as [|r l2]; try easy; intros E P1 P2 l.
  - unfold l; cbn; auto.
  - unfold l. cbn [lower_acc]. rewrite lower_acc_eq. cbn [rev_append].
    inversion P1; inversion P2; subst. destruct (IH l2) as (I1 & I2 & I3); auto.
    destruct (rat_min_sound q r) as (M1 & M2 & M3); auto.
Qed.

Lemma rat_le_refl l : Forall2 rat_le l l.
Proof. induction l; constructor; auto. unfold rat_le; lra. Qed.

Lemma rat_le_trans l1 : forall l2 l3, Forall2 rat_le l1 l2 -> Forall2 rat_le l2 l3 -> Forall2 rat_le l1 l3.
Proof.
  induction l1; intros l2 l3 A B; inversion A; subst; inversion B; subst; constructor; eauto.
  unfold rat_le in *; lra.
Qed.

Lemma all_less_sound k m l1 : below_root k m -> forall l2 l3, Forall proper l1 -> Forall proper l2 ->
  all_less k l1 l2 = true -> Forall2 rat_le l2 l3 ->
  Forall2 (fun q r => ratR q + m < ratR r) l1 l3.
Proof.
  intros K; induction l1 as [|q l1 IH]; destruct l2 as [|r l2]; try easy; intros l3 P1 P2 A L.
  - inversion L; constructor.
  - cbn in A. destruct (rat_over k q r) eqn:E; [|discriminate].
    inversion P1; inversion P2; inversion L; subst. constructor; eauto.
    apply (rat_over_sound k m) in E; auto. unfold rat_le in *; lra.
Qed.

(** A fold of [lower] is below each of its lists. *)
Lemma lower_fold {A} (vals : A -> option (list rat)) n ws : forall o low,
  fold_left (fun l w => lower l (vals w)) ws o = Some low ->
  (forall w us, In w ws -> vals w = Some us -> length us = n /\ Forall proper us) ->
  (forall us, o = Some us -> length us = n /\ Forall proper us) ->
  length low = n /\ Forall proper low /\
  (exists us, o = Some us /\ Forall2 rat_le low us) /\
  forall w, In w ws -> exists us, vals w = Some us /\ Forall2 rat_le low us.
Proof.
  induction ws as [|w ws IH]; cbn; intros o low F Hw Ho.
  - subst. destruct (Ho low eq_refl). repeat split; auto; [|easy].
    exists low; split; auto. apply rat_le_refl.
  - destruct o as [l1|]; [|exfalso; clear - F; induction ws; cbn in F; [easy|auto]].
    destruct (vals w) as [l2|] eqn:E; [|exfalso; clear - F; induction ws; cbn in F; [easy|auto]].
    destruct (Ho _ eq_refl) as [N1 P1]. destruct (Hw w l2) as [N2 P2]; auto.
    destruct (lower_sound l1 l2) as (P & L1 & L2); try lia; auto.
    apply IH in F as (A1 & A2 & (us & E3 & A3) & A4).
    2:{ intros u us Hu; apply Hw; now right. }
    2:{ cbn [lower]. intros us E3. injection E3 as <-. split; auto. rewrite lower_acc_length; cbn; lia. }
    cbn [lower] in E3. injection E3 as <-. repeat split; auto.
    + exists l1; split; auto. eapply rat_le_trans; eauto.
    + intros v [<-|V]; auto. exists l2; split; auto. eapply rat_le_trans; eauto.
Qed.

(** What [apart_by_walk] computes: the lowest of [x] at each time, and that [y] is below. *)
Lemma walk_sound k m n a b d T0 T1 (path : Z -> traj) x y w v : below_root k m -> (0 < d)%Z ->
  (forall u, In u x \/ In u y -> trail u = index (path (vid u)) /\ covers_time T0 T1 (path (vid u))) ->
  apart_by_walk k n a b d x y = true -> In w x -> In v y ->
  forall t, IZR a <= t * IZR d <= IZR b -> far n (path (vid v)) t + m < far n (path (vid w)) t.
Proof.
  intros K0 D C. unfold apart_by_walk. destruct x as [|w0 ws]; [easy|].
  set (cs := fold_left _ y _). generalize cs as cs'; clear cs; intros cs.
  destruct cs as [|c cs]; [discriminate|].
  destruct (c =? a)%Z eqn:E; [|discriminate]. apply Z.eqb_eq in E as ->.
  destruct (fold_left _ ws _) as [low|] eqn:F; [|discriminate].
  intros A Hw Hv t Ht.
  assert (forall u us, In u (w0 :: ws) \/ In u y -> values n a b d (a :: cs) (trail u) = Some us ->
          (length us = S (length cs) /\ Forall proper us) /\
          knots (far n (path (vid u))) d a (a :: cs) us /\ IZR b <= IZR (final a (a :: cs))) as V.
  { intros u us I U. destruct (C u I) as [E W]. rewrite E in U.
    eapply values_sound in U; eauto. destruct U as [K B]. repeat split; auto.
    - now apply knots_length in K.
    - now apply knots_proper in K. }
  apply lower_fold with (n := S (length cs)) in F as (N & P & (u0 & E0 & L0) & L).
  - assert (exists us, values n a b d (a :: cs) (trail w) = Some us /\ Forall2 rat_le low us) as (us & Ew & Lw).
    { destruct Hw as [<-|Hw]; eauto. }
    pose proof (proj1 (forallb_forall _ _) A v Hv) as Av. cbn beta in Av.
    destruct (values n a b d (a :: cs) (trail v)) as [vs|] eqn:Ev; [|discriminate].
    apply V in Ew as (_ & Kw & B); auto. apply V in Ev as ((_ & Pv) & Kv & _); auto.
    eapply all_less_sound in Av; eauto.
    eapply (knots_less _ _ _ d D _ a vs us); eauto; [|lra].
    destruct vs as [|q vs], us as [|r us]; try easy. inversion Av; subst.
    destruct Kw as (_ & _ & _ & <- & _), Kv as (_ & _ & _ & <- & _). auto.
  - intros u us Hu Eu. apply V in Eu; cbn; tauto.
  - intros us Eu. apply V in Eu; cbn; tauto.
Qed.

(** *** Quick bounds *)

Lemma div_bounds x w : (0 < w)%Z -> IZR (x / w) * IZR w <= IZR x < (IZR (x / w) + 1) * IZR w.
Proof.
  intros W. pose proof (Z.div_mod x w) as E. pose proof (Z.mod_pos_bound x w W) as B.
  rewrite <- plus_IZR, <- !mult_IZR. split; [apply IZR_le|apply IZR_lt]; lia.
Qed.

(** 2^s as a real number. *)
Definition pow (s : Z) : R := IZR (2 ^ s).

Lemma pow_positive s : (0 <= s)%Z -> 0 < pow s.
Proof. intros S. apply IZR_lt. lia. Qed.

Lemma shiftr_bounds x s : (0 <= s)%Z -> IZR (Z.shiftr x s) * pow s <= IZR x < (IZR (Z.shiftr x s) + 1) * pow s.
Proof. intros S. rewrite Z.shiftr_div_pow2 by auto. apply div_bounds. lia. Qed.

(** On one axis: a breakpoint at [x], a part [h] of the time after [T0], is as far from the line as [stray]
    says, up to [slack]. *)
Lemma stray_axis s T W o w x : (0 <= s)%Z -> (0 < W)%Z ->
  let u := (Z.shiftl T time_bits / W)%Z in
  let m := IZR (Z.shiftr x s - (o + Z.shiftr (w * u) time_bits)) in
  let l := IZR o + IZR w * (IZR T / IZR W) in
  pow s * (l + m - IZR (slack w)) <= IZR x <= pow s * (l + m + IZR (slack w)).
Proof.
  intros S P u m l. set (h := IZR T / IZR W) in *.
  assert (0 <= time_bits)%Z as B by easy. pose proof (pow_positive _ B) as K0. pose proof (pow_positive s S) as S0.
  set (K := pow time_bits) in *.
  assert (IZR u <= K * h < IZR u + 1) as [U1 U2].
  { apply IZR_lt in P as P'. pose proof (div_bounds (Z.shiftl T time_bits) W P) as [D1 D2]. fold u in D1, D2.
    rewrite Z.shiftl_mul_pow2, mult_IZR in D1, D2 by auto. fold (pow time_bits) in D1, D2. fold K in D1, D2.
    assert (h * IZR W = IZR T) as E by (unfold h; field; lra).
    split; [apply Rmult_le_reg_r with (IZR W)|apply Rmult_lt_reg_r with (IZR W)]; nra. }
  pose proof (shiftr_bounds (w * u) time_bits B) as [M1 M2]. fold K in M1, M2. rewrite mult_IZR in M1, M2.
  pose proof (shiftr_bounds (Z.abs w) time_bits B) as [A1 A2]. fold K in A1, A2.
  pose proof (shiftr_bounds x s S) as [X1 X2].
  unfold m, l, slack. repeat (rewrite minus_IZR || rewrite plus_IZR).
  set (q := IZR (Z.shiftr x s)) in *. set (v := IZR (Z.shiftr (w * u) time_bits)) in *.
  set (a := IZR (Z.shiftr (Z.abs w) time_bits)) in *.
  assert (- IZR (Z.abs w) <= IZR w <= IZR (Z.abs w)) as [W1 W2]
    by (rewrite <- opp_IZR; split; apply IZR_le; lia).
  assert (v - a - 1 <= IZR w * h <= v + a + 1 + 1) as [V1 V2].
  { split; apply Rmult_le_reg_l with K; auto; nra. }
  split.
  - apply Rle_trans with (q * pow s); [|lra]. rewrite (Rmult_comm q). apply Rmult_le_compat_l; lra.
  - apply Rle_trans with ((q + 1) * pow s); [lra|]. rewrite (Rmult_comm (q + 1)). apply Rmult_le_compat_l; lra.
Qed.

(** Two steps divide as one does. *)
Lemma part_sound t w : (0 < w)%Z -> part t w = (Z.shiftl t time_bits / w)%Z.
Proof.
  intros W. unfold part. set (t' := Z.shiftl t half_bits). cbv zeta.
  replace (Z.shiftl t time_bits) with (Z.shiftl t' half_bits) by (unfold t'; now rewrite Z.shiftl_shiftl).
  rewrite !(Z.shiftl_mul_pow2 _ half_bits) by easy. rewrite <- Z.div_add_l by lia. f_equal. ring.
Qed.

(** What is true of breakpoints is true between them. *)
Lemma above_line n u v r : forall t0 p0, increasing t0 r ->
  u + v * IZR t0 <= dotR n (inj p0) -> (forall t p, In (t, p) r -> u + v * IZR t <= dotR n (inj p)) ->
  forall t, IZR t0 <= t <= IZR (last_time t0 r) -> u + v * t <= dotR n (pos_from t0 p0 r t).
Proof.
  induction r as [|(t1, p1) r IH]; cbn [increasing last_time pos_from]; intros t0 p0 W H0 H t T.
  - replace t with (IZR t0) by lra. exact H0.
  - assert (u + v * IZR t1 <= dotR n (inj p1)) as H1 by (apply H; now left).
    destruct W as [L W]. apply IZR_lt in L. destruct (Rle_dec t (IZR t1)) as [T1|T1].
    + apply Rmult_le_reg_l with (IZR t1 - IZR t0); [lra|].
      replace (_ * dotR _ _) with (dotR n (inj p0) * (IZR t1 - t) + dotR n (inj p1) * (t - IZR t0))
        by (unfold dotR, mix; cbn; field; lra).
      assert ((u + v * IZR t0) * (IZR t1 - t) <= dotR n (inj p0) * (IZR t1 - t)) by (apply Rmult_le_compat_r; lra).
      assert ((u + v * IZR t1) * (t - IZR t0) <= dotR n (inj p1) * (t - IZR t0)) by (apply Rmult_le_compat_r; lra).
      lra.
    + apply IH; auto; [|lra]. intros; apply H; now right.
Qed.

Definition vec_le (p q : vec) : Prop := (vx p <= vx q /\ vy p <= vy q /\ vz p <= vz q)%Z.

Lemma vec_le_trans p q r : vec_le p q -> vec_le q r -> vec_le p r.
Proof. unfold vec_le; lia. Qed.

Lemma lesser_sound a b : (lesser a b <= a /\ lesser a b <= b)%Z.
Proof. unfold lesser. destruct (Z.ltb_spec b a); lia. Qed.

Lemma greater_left a b : (a <= greater a b)%Z.
Proof. unfold greater. destruct (Z.ltb_spec a b); lia. Qed.

Lemma by_axis_lesser p q : vec_le (by_axis lesser p q) p /\ vec_le (by_axis lesser p q) q.
Proof.
  unfold vec_le; cbn. pose proof (lesser_sound (vx p) (vx q)). pose proof (lesser_sound (vy p) (vy q)).
  pose proof (lesser_sound (vz p) (vz q)). tauto.
Qed.

Lemma by_axis_greater p q : vec_le p (by_axis greater p q) /\ vec_le q (by_axis greater p q).
Proof.
  unfold vec_le, greater; cbn. destruct (Z.ltb_spec (vx p) (vx q)), (Z.ltb_spec (vy p) (vy q)),
    (Z.ltb_spec (vz p) (vz q)); lia.
Qed.

Lemma strays_sound s T0 W o w r : forall l h, let e := strays (coarse s) T0 W o w r l h in
  vec_le (fst e) l /\ vec_le h (snd e) /\
  forall t p, In (t, p) r ->
    vec_le (fst e) (stray T0 W o w t (coarse s p)) /\ vec_le (stray T0 W o w t (coarse s p)) (snd e).
Proof.
  induction r as [|(t1, p1) r IH]; intros l h e; cbn [strays] in e.
  - unfold e, vec_le; cbn. split; [lia|]. split; [lia|easy].
  - destruct (IH (by_axis lesser l (stray T0 W o w t1 (coarse s p1)))
                 (by_axis greater h (stray T0 W o w t1 (coarse s p1))))
      as (L & H & A). fold e in L, H, A.
    destruct (by_axis_lesser l (stray T0 W o w t1 (coarse s p1))), (by_axis_greater h (stray T0 W o w t1 (coarse s p1))).
    split; [eauto using vec_le_trans|]. split; [eauto using vec_le_trans|].
    intros t p [[= <- <-]|I]; [eauto using vec_le_trans|now apply A].
Qed.

Lemma last_from_time (r : traj) : forall t p, fst (last_from t p r) = last_time t r.
Proof. induction r as [|(t1, p1) r IH]; cbn; auto. Qed.

(** What [least_from] has of a vertex, in integers of any length: what one axis, and all, contribute, and both ends. *)
Definition axis_stray (n l h : Z) : Z := (if 0 <=? n then n * l else n * h)%Z.
Definition least_stray (n : vec) (c : chord) : Z :=
  (axis_stray (vx n) (vx (lows c)) (vx (highs c)) + axis_stray (vy n) (vy (lows c)) (vy (highs c))
   + axis_stray (vz n) (vz (lows c)) (vz (highs c)))%Z.
Definition least_ends (n : vec) (d j : Z) (c : chord) : Z * Z :=
  let m := dot n (motion c) in
  let g := (d * (dot n (origin c) + least_stray n c) + j * m)%Z in
  (g, g + m)%Z.

(** What one axis contributes is the least of it. *)
Lemma axis_stray_sound n l h (G x c : R) : 0 < G -> G * (c + IZR l) <= x <= G * (c + IZR h) ->
  G * (IZR n * c + IZR (axis_stray n l h)) <= IZR n * x.
Proof.
  intros P [L H]. unfold axis_stray. destruct (0 <=? n)%Z eqn:E; to_R.
  - assert (IZR n * (G * (c + IZR l)) <= IZR n * x) by (apply Rmult_le_compat_l; auto). lra.
  - assert (- IZR n * x <= - IZR n * (G * (c + IZR h))) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(** A vertex is as its chord says. *)
Lemma chord_sound s T0 T1 tr c : (0 <= s)%Z -> covers_time T0 T1 tr -> chord_of s T0 T1 tr = Some c ->
  grain c = (2 ^ s)%Z /\ (T0 < T1)%Z /\ forall n t, IZR T0 <= t <= IZR T1 ->
  pow s * (IZR (dot n (origin c) + least_stray n c)
           + IZR (dot n (motion c)) * ((t - IZR T0) / (IZR T1 - IZR T0))) <= far n tr t.
Proof.
  destruct tr as [|(t0, p0) r]; [easy|]. intros S (_ & I & _). unfold chord_of, chord_by. rewrite last_from_time.
  destruct (_ && _)%bool eqn:E; [|discriminate]. rewrite !andb_true_iff, !Z.eqb_eq, Z.ltb_lt in E.
  destruct E as [[-> E] L]. cbv zeta. set (o := coarse s p0).
  set (w := by_axis Z.sub _ o). intros [= <-].
  destruct (strays_sound s T0 (T1 - T0) o w r (V3 0 0 0) (V3 0 0 0)) as (SL & SH & SA).
  set (lh := strays _ _ _ _ _ _ _ _) in *.
  split; [cbn [grain]; now rewrite Z.shiftl_mul_pow2, Z.mul_1_l by auto|]. split; auto.
  cbn [origin motion]. set (c := Chord _ _ _ _ _). intros n t Ht. unfold far; cbn [pos].
  assert (0 < T1 - T0)%Z as W by lia. pose proof (pow_positive s S) as P.
  set (g := IZR (dot n o + least_stray n c)). set (m := IZR (dot n w)).
  assert (forall t p, vec_le (fst lh) (stray T0 (T1 - T0) o w t (coarse s p)) ->
    vec_le (stray T0 (T1 - T0) o w t (coarse s p)) (snd lh) ->
    pow s * (g + m * ((IZR t - IZR T0) / (IZR T1 - IZR T0))) <= dotR n (inj p)) as A.
  { clear t Ht. intros t p (L1 & L2 & L3) (H1 & H2 & H3).
    unfold stray, coarse in *; cbn [by_axis vx vy vz] in *. rewrite part_sound in L1, L2, L3, H1, H2, H3 by exact W.
    unfold g, m, dot, least_stray, c, dotR, inj; cbn [lows highs by_axis vx vy vz px py pz].
    repeat (rewrite plus_IZR || rewrite mult_IZR). rewrite <- !minus_IZR.
    assert (forall n l h x o w, let q := (Z.shiftr x s - (o + Z.shiftr (w * (Z.shiftl (t - T0) time_bits / (T1 - T0))) time_bits))%Z in
      (l <= q)%Z -> (q <= h)%Z ->
      pow s * (IZR n * (IZR o + IZR w * (IZR (t - T0) / IZR (T1 - T0))) + IZR (axis_stray n (l - slack w) (h + slack w))) <= IZR n * IZR x)
      as B.
    { clear - S P W. intros n l h x o w q L H. apply axis_stray_sound; auto.
      destruct (stray_axis s (t - T0) (T1 - T0) o w x S W) as [X1 X2]. fold q in X1, X2.
      apply IZR_le in L, H. rewrite (minus_IZR l), (plus_IZR h).
      split; [apply Rle_trans with (2 := X1)|apply Rle_trans with (1 := X2)];
        apply Rmult_le_compat_l; lra. }
    pose proof (B (vx n) _ _ _ _ _ L1 H1). pose proof (B (vy n) _ _ _ _ _ L2 H2).
    pose proof (B (vz n) _ _ _ _ _ L3 H3). lra. }
  apply IZR_lt in L as L'.
  replace (pow s * _) with (pow s * (g - m * (IZR T0 / (IZR T1 - IZR T0))) + pow s * m / (IZR T1 - IZR T0) * t)
    by (field; lra).
  assert (forall t', pow s * (g - m * (IZR T0 / (IZR T1 - IZR T0))) + pow s * m / (IZR T1 - IZR T0) * t'
    = pow s * (g + m * ((t' - IZR T0) / (IZR T1 - IZR T0)))) as F by (intros; field; lra).
  apply above_line; auto.
  - rewrite F. apply A.
    + apply vec_le_trans with (1 := SL). unfold stray, vec_le, o, coarse. rewrite Z.sub_diag, part_sound, Z.shiftl_0_l by exact W.
      rewrite Z.div_0_l by lia. cbn [by_axis vx vy vz]. rewrite !Z.mul_0_r, Z.shiftr_0_l. lia.
    + apply vec_le_trans with (2 := SH). unfold stray, vec_le, o, coarse. rewrite Z.sub_diag, part_sound, Z.shiftl_0_l by exact W.
      rewrite Z.div_0_l by lia. cbn [by_axis vx vy vz]. rewrite !Z.mul_0_r, Z.shiftr_0_l. lia.
  - intros t' p' I'. rewrite F. now apply A; apply SA.
  - rewrite E. exact Ht.
Qed.

(** The word [a] is the integer [x], of at most [B]. *)
Definition is_word (a : word) (x B : Z) : Prop := (val a = x /\ Z.abs x <= B)%Z.

Lemma to_word_val z : (- 2 ^ 62 <= z < 2 ^ 62)%Z -> val (to_word z) = z.
Proof. intros H. cbn [val to_word]. rewrite Z.mod_small; lia. Qed.

Lemma to_word_sound z B : (Z.abs z <= B)%Z -> (B < 2 ^ 62)%Z -> is_word (to_word z) z B.
Proof. intros H L. split; auto. apply to_word_val. lia. Qed.

Lemma word_add_sound a b x y A B : is_word a x A -> is_word b y B -> (A + B < 2 ^ 62)%Z ->
  is_word (word_add a b) (x + y) (A + B).
Proof. intros [<- Ha] [<- Hb] L. apply to_word_sound; lia. Qed.

Lemma word_mul_sound a b x y A B : is_word a x A -> is_word b y B -> (A * B < 2 ^ 62)%Z ->
  is_word (word_mul a b) (x * y) (A * B).
Proof.
  intros [<- Ha] [<- Hb] L. apply to_word_sound; auto. rewrite Z.abs_mul. apply Z.mul_le_mono_nonneg; lia.
Qed.

Lemma word_lesser_val a b : val (word_lesser a b) = lesser (val a) (val b).
Proof. unfold word_lesser, word_lt, lesser. now destruct (val b <? val a)%Z. Qed.

Lemma least_on_sound a l h n o x y N L : is_word a n N -> is_word l (o + x) L -> is_word h (o + y) L ->
  (N * L < 2 ^ 62)%Z -> is_word (least_on a l h) (n * o + axis_stray n x y) (N * L).
Proof.
  intros Ha Hl Hh B. unfold least_on, word_lt, axis_stray. rewrite (proj1 Ha).
  replace (val word_zero) with 0%Z by reflexivity. destruct (Z.ltb_spec n 0), (Z.leb_spec 0 n); try lia.
  - replace (n * o + n * y)%Z with (n * (o + y))%Z by ring. now apply word_mul_sound.
  - replace (n * o + n * x)%Z with (n * (o + x))%Z by ring. now apply word_mul_sound.
Qed.

Lemma short_sound B p : short B p = true -> (Z.abs (vx p) <= B /\ Z.abs (vy p) <= B /\ Z.abs (vz p) <= B)%Z.
Proof. unfold short. rewrite !andb_true_iff, !Z.leb_le. tauto. Qed.

(** What words compute of a vertex is what integers would, and far enough from 2^62. *)
Definition most_end : Z := (2 ^ 61 - 1)%Z.

Lemma band_ends n d j c q : short most_direction n = true -> (0 < d <= d_quick)%Z -> (0 <= j <= d_quick)%Z ->
  band_of c = Some q ->
  let nx := to_word (vx n) in let ny := to_word (vy n) in let nz := to_word (vz n) in
  let l := word_add (word_add (least_on nx (lx q) (hx q)) (least_on ny (ly q) (hy q)))
             (least_on nz (lz q) (hz q)) in
  let m := word_add (word_add (word_mul nx (mx q)) (word_mul ny (my q))) (word_mul nz (mz q)) in
  let g := word_add (word_mul (to_word d) l) (word_mul (to_word j) m) in
  is_word g (fst (least_ends n d j c)) most_end /\ is_word (word_add g m) (snd (least_ends n d j c)) most_end.
Proof.
  intros N D J. unfold band_of. destruct (_ && _)%bool eqn:E; [|discriminate]. intros [= <-]. cbv zeta.
  rewrite !andb_true_iff in E. destruct E as [[L H] M]. apply short_sound in N as (N1 & N2 & N3).
  apply short_sound in L as (L1 & L2 & L3), H as (H1 & H2 & H3), M as (M1 & M2 & M3).
  cbn [lx ly lz hx hy hz mx my mz by_axis vx vy vz] in *.
  assert (forall z, (Z.abs z <= most_direction)%Z -> is_word (to_word z) z most_direction) as WN
    by (intros; now apply to_word_sound).
  assert (forall z, (Z.abs z <= most_place)%Z -> is_word (to_word z) z most_place) as WP
    by (intros; now apply to_word_sound).
  assert (forall z, (0 <= z <= d_quick)%Z -> is_word (to_word z) z d_quick) as WD
    by (intros; apply to_word_sound; [lia|reflexivity]).
  assert (is_word (to_word d) d d_quick) as Wd by (apply WD; lia). specialize (WD j J).
  set (l := word_add (word_add (least_on _ _ _) _) _). set (m := word_add (word_add (word_mul _ _) _) _).
  assert (is_word l (dot n (origin c) + least_stray n c) (3 * (most_direction * most_place))) as Wl.
  { unfold l. replace (dot n (origin c) + least_stray n c)%Z with
      (vx n * vx (origin c) + axis_stray (vx n) (vx (lows c)) (vx (highs c)) +
       (vy n * vy (origin c) + axis_stray (vy n) (vy (lows c)) (vy (highs c))) +
       (vz n * vz (origin c) + axis_stray (vz n) (vz (lows c)) (vz (highs c))))%Z
      by (unfold dot, least_stray; ring).
    change (3 * (most_direction * most_place))%Z with
      (most_direction * most_place + most_direction * most_place + most_direction * most_place)%Z.
    repeat apply word_add_sound; try reflexivity; apply least_on_sound; auto; reflexivity. }
  assert (is_word m (dot n (motion c)) (3 * (most_direction * most_place))) as Wm.
  { unfold m, dot. change (3 * (most_direction * most_place))%Z with
      (most_direction * most_place + most_direction * most_place + most_direction * most_place)%Z.
    repeat apply word_add_sound; try reflexivity; apply word_mul_sound; auto; reflexivity. }
  pose proof (word_mul_sound _ _ _ _ _ _ Wd Wl eq_refl) as W1.
  pose proof (word_mul_sound _ _ _ _ _ _ WD Wm eq_refl) as W2.
  pose proof (word_add_sound _ _ _ _ _ _ W1 W2 eq_refl) as Wg.
  pose proof (word_add_sound _ _ _ _ _ _ Wg Wm eq_refl) as We.
  assert (forall a x A, (A <= most_end)%Z -> is_word a x A -> is_word a x most_end) as Up
    by (intros a x A HA [V B]; split; [auto|lia]).
  split; [apply Up with (2 := Wg)|apply Up with (2 := We)]; easy.
Qed.

(** The lesser of both ends, of all vertices: [P] says which chord a vertex has. *)
Lemma least_from_sound n d j (P : vertex -> chord -> Prop) x : short most_direction n = true ->
  (0 < d <= d_quick)%Z -> (0 <= j <= d_quick)%Z ->
  (forall v q, In v x -> line v = Some q -> exists c, P v c /\ band_of c = Some q) ->
  forall g0 g1 g, least_from (to_word (vx n)) (to_word (vy n)) (to_word (vz n)) (to_word d) (to_word j) x g0 g1 = Some g ->
  (- most_end <= val g0)%Z -> (- most_end <= val g1)%Z ->
  (- most_end <= val (fst g) <= val g0)%Z /\ (- most_end <= val (snd g) <= val g1)%Z /\
  forall v, In v x -> exists c, P v c /\
    (val (fst g) <= fst (least_ends n d j c) <= most_end)%Z /\ (val (snd g) <= snd (least_ends n d j c) <= most_end)%Z.
Proof.
  intros N D J. induction x as [|v x IH]; cbn [least_from]; intros C g0 g1 g.
  - intros [= <-] B0 B1. cbn [fst snd]. split; [lia|]. split; [lia|easy].
  - destruct (line v) as [q|] eqn:E; [|discriminate]. cbv zeta. intros H B0 B1.
    destruct (C v q (or_introl eq_refl) E) as (c & Pc & Q).
    destruct (band_ends n d j c q N D J Q) as [[V0 A0] [V1 A1]]. cbv zeta in V0, V1.
    pose proof (lesser_sound (val g0) (fst (least_ends n d j c))) as S0.
    pose proof (lesser_sound (val g1) (snd (least_ends n d j c))) as S1.
    assert (forall a b, (- most_end <= a -> - most_end <= b -> - most_end <= lesser a b)%Z) as S
      by (intros a b; unfold lesser; destruct (b <? a)%Z; auto).
    apply IH in H.
    + rewrite !word_lesser_val, V0, V1 in H. destruct H as (H0 & H1 & H). split; [lia|]. split; [lia|].
      intros u [<-|I]; [|now apply H]. exists c. split; auto. lia.
    + intros u r I. apply C. now right.
    + rewrite word_lesser_val, V0. apply S; lia.
    + rewrite word_lesser_val, V1. apply S; lia.
Qed.

Lemma far_opposite n tr t : far (opposite n) tr t = - far n tr t.
Proof. unfold far, dotR, opposite; cbn. rewrite !opp_IZR. ring. Qed.

(** During the [j]-th part of the time, of which [h] has gone by, bounds at its ends say where a vertex is. *)
Lemma ends_sound s T0 T1 tr c n d j g h t : (0 <= s)%Z -> (0 < d)%Z -> covers_time T0 T1 tr ->
  chord_of s T0 T1 tr = Some c ->
  (fst g <= fst (least_ends n d j c) /\ snd g <= snd (least_ends n d j c))%Z ->
  IZR T0 <= t <= IZR T1 -> 0 <= h <= 1 -> (t - IZR T0) * IZR d = (IZR j + h) * (IZR T1 - IZR T0) ->
  pow s * ((1 - h) * IZR (fst g) + h * IZR (snd g)) <= IZR d * far n tr t.
Proof.
  intros S D C E [G0 G1] Ht Hh J. destruct (chord_sound s T0 T1 tr c S C E) as (_ & L & A).
  specialize (A n t Ht). apply IZR_lt in L, D. unfold least_ends in *; cbn [fst snd] in *.
  apply IZR_le in G0, G1. repeat (rewrite plus_IZR in G0 || rewrite mult_IZR in G0).
  repeat (rewrite plus_IZR in G1 || rewrite mult_IZR in G1).
  rewrite plus_IZR in A. set (f := IZR (dot n (origin c))) in *. set (m := IZR (dot n (motion c))) in *.
  replace ((t - IZR T0) / (IZR T1 - IZR T0)) with ((IZR j + h) / IZR d) in A.
  2:{ apply (Rmult_eq_reg_r (IZR d * (IZR T1 - IZR T0))); [|nra]. field_simplify; lra. }
  apply Rle_trans with (IZR d * (pow s * (f + IZR (least_stray n c) + m * ((IZR j + h) / IZR d))));
    [|apply Rmult_le_compat_l; lra].
  replace (IZR d * _) with (pow s * (IZR d * (f + IZR (least_stray n c)) + (IZR j + h) * m)) by (field; lra).
  apply Rmult_le_compat_l; [apply Rlt_le; now apply pow_positive|].
  assert ((1 - h) * IZR (fst g) <= (1 - h) * (IZR d * (f + IZR (least_stray n c)) + IZR j * m))
    by (apply Rmult_le_compat_l; lra).
  assert (h * IZR (snd g) <= h * (IZR d * (f + IZR (least_stray n c)) + IZR j * m + m))
    by (apply Rmult_le_compat_l; lra). lra.
Qed.

(** What [apart_by_bounds] computes: the least at both ends, and that their sum is large enough. *)
Lemma bounds_sound k m n a b d s T0 T1 (path : Z -> traj) x y w v : below_root k m -> (0 < d)%Z -> (0 <= s)%Z ->
  (forall u, In u x \/ In u y ->
    line u = line_of s T0 T1 (path (vid u)) /\ covers_time T0 T1 (path (vid u))) ->
  apart_by_bounds T0 T1 k n a b d x y = true -> In w x -> In v y ->
  forall t, IZR a <= t * IZR d <= IZR b -> IZR T0 <= t <= IZR T1 ->
  far n (path (vid v)) t + m < far n (path (vid w)) t.
Proof.
  intros [M K] D S C. unfold apart_by_bounds. destruct (_ && _)%bool eqn:DN; [|discriminate]. cbv zeta.
  set (j := ((a - T0 * d) / (T1 - T0))%Z). destruct (_ && _ && _)%bool eqn:B; [|discriminate].
  destruct (least_of n d j x) as [g|] eqn:X; [|discriminate].
  destruct (least_of (opposite n) d j y) as [g'|] eqn:Y; [|discriminate].
  set (q' := word_lesser _ _). destruct (word_lt word_zero q') eqn:Q; [|discriminate]. intros A Hw Hv t Ht HT.
  rewrite !andb_true_iff, !Z.leb_le in B. destruct B as [[J0 J1] B].
  rewrite andb_true_iff, Z.leb_le in DN. destruct DN as [DQ N].
  set (P := fun (u : vertex) c => chord_of s T0 T1 (path (vid u)) = Some c).
  assert (forall z, (forall u, In u z -> In u x \/ In u y) ->
    forall u r, In u z -> line u = Some r -> exists c, P u c /\ band_of c = Some r) as CP.
  { intros z Z u r I E. destruct (C u (Z u I)) as [F _]. rewrite E in F. unfold P, line_of in *.
    destruct (chord_of _ _ _ _) as [c|]; [|discriminate]. exists c. auto. }
  assert (match grain_of x with Some e => e = (2 ^ s)%Z | None => True end) as G.
  { clear - C S. destruct x as [|u x]; cbn; auto. destruct (C u) as [E W]; [left; now left|].
    destruct (line u) as [r|]; auto. unfold line_of in E. destruct (chord_of _ _ _ _) as [c|] eqn:F; [|discriminate].
    apply chord_sound in F as [F _]; auto. unfold band_of in E. destruct (_ && _)%bool; [|discriminate].
    injection E as ->. exact F. }
  assert (short most_direction (opposite n) = true) as N'.
  { unfold short, opposite in *. cbn [vx vy vz]. now rewrite !Z.abs_opp. }
  destruct (least_from_sound n d j P x N (conj D DQ) (conj J0 J1) (CP x (fun u I => or_introl I)) _ _ _ X)
    as (X0 & X1 & Gw); try easy.
  destruct (least_from_sound (opposite n) d j P y N' (conj D DQ) (conj J0 J1) (CP y (fun u I => or_intror I)) _ _ _ Y)
    as (Y0 & Y1 & Gv); try easy.
  destruct (Gw w Hw) as (cw & Lw & Gw0 & Gw1), (Gv v Hv) as (cv & Lv & Gv0 & Gv1). clear Gw Gv. unfold P in Lw, Lv.
  destruct (C w (or_introl Hw)) as [_ Ww], (C v (or_intror Hv)) as [_ Wv].
  set (q := lesser (val (fst g) + val (fst g')) (val (snd g) + val (snd g'))).
  assert (val q' = q) as Eq.
  { unfold q', q. rewrite word_lesser_val. unfold word_add. rewrite !to_word_val; auto; unfold most_end in *; lia. }
  unfold word_lt in Q. rewrite Eq in Q. rewrite Eq in A. replace (val word_zero) with 0%Z in Q by reflexivity.
  destruct (chord_sound s T0 T1 _ cw S Ww Lw) as (_ & L & _).
  assert (0 < T1 - T0)%Z as W by lia. pose proof (div_bounds (a - T0 * d) (T1 - T0) W) as [J _]. fold j in J.
  apply IZR_lt in L, D as D'. apply IZR_le in B. apply Z.ltb_lt, IZR_lt in Q.
  repeat (rewrite plus_IZR in B || rewrite mult_IZR in B || rewrite minus_IZR in B).
  repeat (rewrite mult_IZR in J || rewrite minus_IZR in J).
  set (h := ((t - IZR T0) * IZR d - IZR j * (IZR T1 - IZR T0)) / (IZR T1 - IZR T0)).
  assert (h * (IZR T1 - IZR T0) = (t - IZR T0) * IZR d - IZR j * (IZR T1 - IZR T0)) as Eh by (unfold h; field; lra).
  assert (0 <= h <= 1) as Hh.
  { split; apply (Rmult_le_reg_r (IZR T1 - IZR T0)); lra. }
  assert ((t - IZR T0) * IZR d = (IZR j + h) * (IZR T1 - IZR T0)) as J' by lra.
  pose proof (ends_sound s T0 T1 _ cw n d j (val (fst g), val (snd g)) h t S D Ww Lw
    (conj (proj1 Gw0) (proj1 Gw1)) HT Hh J') as Bw.
  pose proof (ends_sound s T0 T1 _ cv (opposite n) d j (val (fst g'), val (snd g')) h t S D Wv Lv
    (conj (proj1 Gv0) (proj1 Gv1)) HT Hh J') as Bv.
  rewrite far_opposite in Bv. cbn [fst snd] in Bw, Bv.
  destruct (lesser_sound (val (fst g) + val (fst g')) (val (snd g) + val (snd g'))) as [Q0 Q1]. fold q in Q0, Q1.
  apply IZR_le in Q0, Q1. rewrite plus_IZR in Q0, Q1. pose proof (pow_positive s S) as P0.
  assert (pow s * IZR q <= IZR d * (far n (path (vid w)) t - far n (path (vid v)) t)) as F.
  { apply Rle_trans with (pow s * ((1 - h) * (IZR (val (fst g)) + IZR (val (fst g'))) + h * (IZR (val (snd g)) + IZR (val (snd g'))))); [|lra].
    apply Rmult_le_compat_l; [lra|].
    assert ((1 - h) * IZR q <= (1 - h) * (IZR (val (fst g)) + IZR (val (fst g')))) by (apply Rmult_le_compat_l; lra).
    assert (h * IZR q <= h * (IZR (val (snd g)) + IZR (val (snd g')))) by (apply Rmult_le_compat_l; lra). lra. }
  assert (IZR d * m < pow s * IZR q) as R.
  { assert (0 < pow s * IZR q) by (apply Rmult_lt_0_compat; lra).
    destruct (Z.eqb_spec k 0) as [->|_].
    - assert (m = 0) as -> by nra. lra.
    - destruct (grain_of x) as [e|]; [|discriminate]. subst e. apply Z.ltb_lt, IZR_lt in A. rewrite !mult_IZR in A. fold (pow s) in A.
      apply less_by_squares; auto. apply Rle_lt_trans with (2 := A).
      assert (IZR d * IZR d * (m * m) <= IZR d * IZR d * IZR k) by (apply Rmult_le_compat_l; [nra|auto]). lra. }
  apply Rmult_lt_reg_l with (IZR d); auto. lra.
Qed.

(** All ways to see that a direction separates, but for planes. *)
Lemma further_sound k m n a b d s T0 T1 (path : Z -> traj) x y w v : below_root k m -> (0 < d)%Z -> (0 <= s)%Z ->
  (forall u, In u x \/ In u y -> trail u = index (path (vid u)) /\
    covers_time T0 T1 (path (vid u)) /\ line u = line_of s T0 T1 (path (vid u))) ->
  (empty x || empty y || apart_by_bounds T0 T1 k n a b d x y || apart_by_walk k n a b d x y)%bool = true ->
  In w x -> In v y ->
  forall t, IZR a <= t * IZR d <= IZR b -> IZR T0 <= t <= IZR T1 ->
  far n (path (vid v)) t + m < far n (path (vid w)) t.
Proof.
  intros K D S C. rewrite !orb_true_iff. intros [[[E|E]|E]|E] Hw Hv t Ht HT.
  - now destruct x.
  - now destruct y.
  - apply (bounds_sound k m n a b d s T0 T1 path x y); auto. intros u Hu. destruct (C u Hu) as (? & ? & ?). auto.
  - apply (walk_sound k m n a b d T0 T1 path x y); auto. intros u Hu. destruct (C u Hu) as (? & ? & ?). auto.
Qed.

(** ** 4. Convex hulls *)

(** The empty hull has no point. *)
Lemma hull_nil x : ~ hull [] x.
Proof. intros (w & L & _ & S & _). destruct w; [cbn in S; lra|discriminate]. Qed.

(** A weighted sum is as far in direction [n] as the points in it are at least. *)
Lemma comb_far n (w : list R) : forall l m, length w = length l -> Forall (fun a => 0 <= a) w ->
  (forall p, In p l -> m < dotR n p) ->
  sum w * m <= dotR n (comb w l) /\ 0 <= sum w /\ (0 < sum w -> sum w * m < dotR n (comb w l)).
Proof.
  induction w as [|a w IH]; destruct l as [|p l]; try discriminate; intros m L F P.
  - unfold dotR; cbn; lra.
  - inversion F; subst. destruct (IH l m) as (I1 & I2 & I3); auto.
    { intros; apply P; now right. }
    replace (dotR n (comb (a :: w) (p :: l))) with (a * dotR n p + dotR n (comb w l))
      by (unfold dotR; cbn; ring). cbn [sum].
    assert (m < dotR n p) by (apply P; now left).
    destruct (Rle_lt_or_eq_dec 0 a) as [A|A]; auto.
    + assert (a * m < a * dotR n p) by (apply Rmult_lt_compat_l; auto). lra.
    + subst a. lra.
Qed.

Lemma hull_far n l m x : (forall p, In p l -> m < dotR n p) -> hull l x -> m < dotR n x.
Proof.
  intros P (w & L & F & S & ->). destruct (comb_far n w l m L F P) as (_ & _ & H).
  rewrite S in H. lra.
Qed.

Lemma hull_positive h t l x : (forall p, In p l -> 0 < valueR h t p) -> hull l x -> 0 < valueR h t x.
Proof.
  intros P H. apply (hull_far (normal h) l (IZR (nd h) - IZR (nt h) * t)) in H.
  - unfold valueR. lra.
  - intros p Hp. apply P in Hp. unfold valueR in Hp. lra.
Qed.

Lemma dotR_opposite n p : dotR (opposite n) p = - dotR n p.
Proof. unfold dotR, opposite; cbn; rewrite !opp_IZR; ring. Qed.

(** Hulls are as far from each other in a direction as their points are at least. *)
Lemma hull_apart n m k l x y : (forall p q, In p k -> In q l -> dotR n p + m < dotR n q) ->
  hull k x -> hull l y -> dotR n x + m < dotR n y.
Proof.
  intros H K L. apply (hull_far n l); auto. intros q Q.
  apply (hull_far (opposite n) k (m - dotR n q)) in K.
  - rewrite dotR_opposite in K. lra.
  - intros p P. rewrite dotR_opposite. specialize (H p q P Q). lra.
Qed.

Lemma dist2_sym x y : dist2 x y = dist2 y x.
Proof. unfold dist2. ring. Qed.

(** Points that differ enough in some direction are apart. *)
Lemma dist2_direction n x y e : let g := dotR n y - dotR n x in
  e * e * dotR n (inj n) < g * g -> e ^ 2 < dist2 x y.
Proof.
  intros g E.
  assert (g * g <= dotR n (inj n) * dist2 x y) as C.
  { unfold g, dist2, dotR, inj; cbn [px py pz].
    set (a := IZR (vx n)). set (b := IZR (vy n)). set (c := IZR (vz n)).
    set (p := px x - px y). set (q := py x - py y). set (r := pz x - pz y).
    replace (_ - _) with (- (a * p + b * q + c * r)) by (unfold p, q, r; ring).
    pose proof (Rle_0_sqr (a * q - b * p)). pose proof (Rle_0_sqr (a * r - c * p)).
    pose proof (Rle_0_sqr (b * r - c * q)). unfold Rsqr in *. lra. }
  assert (0 <= dotR n (inj n)) as N.
  { unfold dotR, inj; cbn. pose proof (Rle_0_sqr (IZR (vx n))). pose proof (Rle_0_sqr (IZR (vy n))).
    pose proof (Rle_0_sqr (IZR (vz n))). unfold Rsqr in *. lra. }
  apply Rnot_le_lt. intros L.
  assert (dotR n (inj n) * dist2 x y <= dotR n (inj n) * e ^ 2) by (apply Rmult_le_compat_l; auto). lra.
Qed.
Close Scope R_scope.

(** ** 5. Obligations *)

(** Chords of a scene with a tree are in units of 2 to this. *)
Definition bits_of (s : scene) (g : group) : Z := unit_bits (path s) (group_ids (same s) s g).

Lemma bits_of_least s g : (0 <= bits_of s g)%Z.
Proof. unfold bits_of, unit_bits. apply greater_left. Qed.

Section Soundness.
Variable s : scene.
Variable strict : bool.
Variable bits : Z.  (* chords are in units of 2^bits *)
Hypothesis bits_least : (0 <= bits)%Z.

(** During [a/d, b/d], and the scene's time, features of [P] and [Q] are as [o] says. *)
Definition Apart (o : mode) (a b d : Z) (P Q : list Z) : Prop :=
  forall t, (IZR a <= t * IZR d <= IZR b)%R -> (IZR (tbeg s) <= t <= IZR (tend s))%R ->
  forall S U, incl S P -> incl U Q ->
  forall x y, simplex s S t x -> simplex s U t y ->
  (o <> Far -> disjoint_ids S U -> (0 < dist2 x y)%R) /\
  (o <> Disjoint -> far_ids s S U -> (IZR (eta s) ^ 2 < dist2 x y)%R).

(** The cells below a node: label and vertex ids. *)
Fixpoint leaves (x : tree) : list (Z * list Z) :=
  match x with
  | Leaf l vs => [(l, map vid vs)]
  | Node _ _ x y => leaves x ++ leaves y
  end.

Definition Claimed (o : mode) (a b d : Z) (P Q : Z * list Z) : Prop :=
  ~ is_excluded s (fst P) (fst Q) -> Apart o a b d (snd P) (snd Q).

Definition PairApart o a b d x y := forall P Q, In P (leaves x) -> In Q (leaves y) -> Claimed o a b d P Q.

Fixpoint SelfApart (o : mode) (a b d : Z) (x : tree) : Prop :=
  match x with
  | Leaf l vs => strict = true -> Claimed o a b d (l, map vid vs) (l, map vid vs)
  | Node _ _ x y => SelfApart o a b d x /\ PairApart o a b d x y /\ SelfApart o a b d y
  end.

Definition resolved (w : vertex) : Prop :=
  trail w = index (path s (vid w)) /\ covers_time (tbeg s) (tend s) (path s (vid w)) /\
  line w = line_of bits (tbeg s) (tend s) (path s (vid w)).

Definition vids (l : list vertex) := map vid l.

(** What [build] makes true of a tree, and [step] keeps. *)
Fixpoint inv (x : tree) : Prop :=
  match x with
  | Leaf _ vs => Forall resolved vs
  | Node l vs x y =>
      (vs <> [] -> Forall resolved vs /\ incl (vids (verts x)) (vids vs) /\ incl (vids (verts y)) (vids vs)) /\
      inv x /\ inv y /\ (forall m, l = Some m -> label_of x = Some m /\ label_of y = Some m)
  end.

Definition holds (o : obligation) : Prop :=
  match o with
  | Pair x y o a b d => (0 < d)%Z -> inv x -> inv y -> PairApart o a b d x y
  | Self x o a b d => (0 < d)%Z -> inv x -> SelfApart o a b d x
  end.

Lemma is_excluded_sym l m : is_excluded s l m -> is_excluded s m l.
Proof. unfold is_excluded; tauto. Qed.

Lemma within_refl n v : within s n v v.
Proof. destruct n; cbn; auto. Qed.

Lemma joined_sym u v : joined s u v -> joined s v u.
Proof. intros (i & H & U & V). exists i; auto. Qed.

Lemma within_step n : forall u v w, within s n u v -> joined s v w -> within s (S n) u w.
Proof.
  induction n as [|n IH]; intros u v w H J.
  - cbn in H. subst. right. exists w. cbn. auto.
  - destruct H as [->|(u' & J' & H)].
    + right. exists w. split; auto. apply within_refl.
    + right. exists u'. split; auto. now apply IH with v.
Qed.

Lemma within_sym n : forall u v, within s n u v -> within s n v u.
Proof.
  induction n as [|n IH]; intros u v; cbn; auto. intros [->|(w & J & H)]; auto.
  apply (within_step n v w u); [now apply IH|now apply joined_sym].
Qed.

Lemma disjoint_sym P Q : disjoint_ids P Q -> disjoint_ids Q P.
Proof. intros D v V1 V2; now apply (D v). Qed.

Lemma far_sym P Q : far_ids s P Q -> far_ids s Q P.
Proof. intros F u v Hu Hv N. apply (F v u Hv Hu). now apply within_sym. Qed.

(** Who is far has no vertex in common. *)
Lemma far_disjoint P Q : far_ids s P Q -> disjoint_ids P Q.
Proof. intros F v V1 V2. apply (F v v V1 V2), within_refl. Qed.

Lemma Apart_sym o a b d P Q : Apart o a b d P Q -> Apart o a b d Q P.
Proof.
  intros H t A B S U IS IU x y HS HU. rewrite dist2_sym.
  destruct (H t A B U S IU IS y x HU HS) as [H1 H2].
  split; intros N F; [apply H1|apply H2]; auto using disjoint_sym, far_sym.
Qed.

(** What is true without regard to vertices. *)
Lemma Apart_least o a b d P Q :
  (forall t, (IZR a <= t * IZR d <= IZR b)%R -> (IZR (tbeg s) <= t <= IZR (tend s))%R ->
   forall S U, incl S P -> incl U Q ->
   forall x y, simplex s S t x -> simplex s U t y -> (IZR (least s o) ^ 2 < dist2 x y)%R) ->
  Apart o a b d P Q.
Proof.
  intros H t A B S U IS IU x y HS HU. specialize (H t A B S U IS IU x y HS HU).
  pose proof (pow2_ge_0 (IZR (least s o))). split; intros N _; [lra|].
  destruct o; [exact H|exact H|contradiction].
Qed.

Lemma Claimed_sym o a b d P Q : Claimed o a b d P Q -> Claimed o a b d Q P.
Proof. intros H E. apply Apart_sym, H. intros N; now apply E, is_excluded_sym. Qed.

(** T: the two halves are all of the interval. *)
Lemma Claimed_halves o a b d P Q :
  Claimed o (a + a) (a + b) (d + d) P Q -> Claimed o (a + b) (b + b) (d + d) P Q -> Claimed o a b d P Q.
Proof.
  intros H1 H2 E t A.
  destruct (Rle_dec (t * IZR (d + d)) (IZR (a + b))); [apply H1|apply H2]; auto;
    rewrite !plus_IZR in *; lra.
Qed.

Lemma incl_filter v (L M : list Z) : incl L M -> ~ In v L -> incl L (filter (fun u => negb (u =? v)%Z) M).
Proof.
  intros LM N u Hu. apply filter_In; split; auto. destruct (Z.eqb_spec u v); auto; subst; contradiction.
Qed.

(** D: of two features with no common vertex, one does not have [v]. *)
Lemma Apart_drop o a b d v P Q :
  Apart o a b d (filter (fun u => negb (u =? v)%Z) P) Q ->
  Apart o a b d P (filter (fun u => negb (u =? v)%Z) Q) -> Apart o a b d P Q.
Proof.
  intros H1 H2 t A B S U IS IU x y HS HU.
  assert (disjoint_ids S U -> ~ In v S \/ ~ In v U) as D.
  { intros D. destruct (in_dec Z.eq_dec v S) as [VS|VS]; auto. }
  split; intros N F; pose proof F as F'; [|apply far_disjoint in F']; apply D in F' as [V|V];
    [destruct (H1 t A B S U (incl_filter _ _ _ IS V) IU x y HS HU)|
     destruct (H2 t A B S U IS (incl_filter _ _ _ IU V) x y HS HU)|
     destruct (H1 t A B S U (incl_filter _ _ _ IS V) IU x y HS HU)|
     destruct (H2 t A B S U IS (incl_filter _ _ _ IU V) x y HS HU)]; auto.
Qed.

(** W: of two features that are far, one does not have [v], or the other no end of a way from [v]. *)
Lemma Apart_ring a b d us v P Q : (forall u, In u us -> within s (Z.to_nat (ring s - 1)) v u) ->
  Apart Far a b d (filter (fun w => negb (w =? v)%Z) P) Q ->
  Apart Far a b d P (filter (fun w => negb (existsb (fun u => (u =? w)%Z) us)) Q) -> Apart Far a b d P Q.
Proof.
  intros W H1 H2 t A B S U IS IU x y HS HU. split; intros N F; [contradiction|].
  destruct (in_dec Z.eq_dec v S) as [V|V].
  - assert (incl U (filter (fun w => negb (existsb (fun u => (u =? w)%Z) us)) Q)) as I.
    { intros w Hw. apply filter_In. split; auto. destruct (existsb _ us) eqn:E; auto. exfalso.
      apply existsb_exists in E as (u & Hu & E). apply Z.eqb_eq in E as ->. apply (F v w); auto. }
    destruct (H2 t A B S U IS I x y HS HU); auto.
  - destruct (H1 t A B S U (incl_filter _ _ _ IS V) IU x y HS HU); auto.
Qed.

(** G: the two parts of what [Distance] says. *)
Lemma Apart_parts a b d P Q : Apart Far a b d P Q -> Apart Disjoint a b d P Q -> Apart Distance a b d P Q.
Proof.
  intros H1 H2 t A B S U IS IU x y HS HU. split; intros N F.
  - now apply (H2 t A B S U IS IU x y HS HU).
  - now apply (H1 t A B S U IS IU x y HS HU).
Qed.

Lemma Apart_far a b d P Q : Apart Distance a b d P Q -> Apart Far a b d P Q.
Proof.
  intros H t A B S U IS IU x y HS HU. split; intros N F; [contradiction|].
  now apply (H t A B S U IS IU x y HS HU).
Qed.

(** A way leads where it says. *)
Lemma in_cell_sound i v : in_cell s i v = true ->
  (0 <= i < ncell s)%Z /\ In v (map (same s) (cell s i)).
Proof.
  unfold in_cell. rewrite !andb_true_iff, existsb_exists, Z.leb_le, Z.ltb_lt.
  intros [[L U] (u & I & E)]. apply Z.eqb_eq in E as <-. auto using in_map.
Qed.

Lemma way_end_sound w : forall n v u, way_end s n v w = Some u -> within s (Z.to_nat n) v u.
Proof.
  induction w as [|(i, v1) w IH]; cbn [way_end]; intros n v u.
  - intros [= ->]. apply within_refl.
  - destruct (_ && _)%bool eqn:E; [|discriminate]. rewrite !andb_true_iff in E. destruct E as [[E0 E1] E2].
    apply Z.ltb_lt in E0. apply in_cell_sound in E1 as [B V0], E2 as [_ V1]. intros H.
    replace (Z.to_nat n) with (S (Z.to_nat (n - 1))) by lia. right. exists v1. split; auto.
    now exists i.
Qed.

Lemma way_ends_sound ws n v : forall us, way_ends s n v ws = Some us ->
  forall u, In u us -> within s (Z.to_nat n) v u.
Proof.
  induction ws as [|w ws IH]; cbn [way_ends]; intros us.
  - intros [= <-]. easy.
  - destruct (way_end s n v w) as [u|] eqn:E; [|discriminate].
    destruct (way_ends s n v ws) as [l|]; [|discriminate]. intros [= <-] u' [<-|H]; eauto.
    now apply way_end_sound with w.
Qed.

Lemma without_ids v p : map vid (without v p) = filter (fun u => negb (u =? v)%Z) (map vid p).
Proof.
  unfold without; induction p as [|w p IH]; cbn; auto.
  destruct (vid w =? v)%Z; cbn; now rewrite IH.
Qed.

Lemma without_all_ids us p :
  map vid (without_all us p) = filter (fun w => negb (existsb (fun u => (u =? w)%Z) us)) (map vid p).
Proof.
  unfold without_all; induction p as [|w p IH]; cbn; auto.
  destruct (existsb _ us); cbn; now rewrite IH.
Qed.

Lemma rev_append_in {A} (w : A) l1 l2 : In w (rev_append l1 l2) <-> In w l1 \/ In w l2.
Proof. rewrite rev_append_rev, in_app_iff, <- in_rev. tauto. Qed.

(** The vertices of a group are those that it has itself, or those of its parts. *)
Lemma collect_in w x : forall acc, In w (collect x acc) <-> In w (verts x) \/ In w acc.
Proof.
  induction x as [l vs|l [|v vs] x IHx y IHy]; intros acc.
  - apply rev_append_in.
  - cbn [verts collect]. rewrite !IHx, !IHy. cbn. tauto.
  - apply rev_append_in.
Qed.

Lemma verts_in w l x y : In w (verts (Node l [] x y)) <-> In w (verts x) \/ In w (verts y).
Proof. cbn [verts collect]. rewrite !collect_in. cbn. tauto. Qed.

Lemma inv_verts x : inv x -> Forall resolved (verts x).
Proof.
  induction x as [l vs|l [|v vs] x IHx y IHy]; cbn [inv]; auto.
  - intros (_ & Ix & Iy & _). specialize (IHx Ix). specialize (IHy Iy). rewrite Forall_forall in *.
    intros w H. apply verts_in in H as [H|H]; auto.
  - intros (H & _). now apply H.
Qed.

Lemma inv_filter f p : Forall resolved p -> Forall resolved (filter f p).
Proof. rewrite !Forall_forall; intros H w I; apply filter_In in I; now apply H. Qed.

(** A node has the vertices of its cells. *)
Lemma leaf_verts x P : inv x -> In P (leaves x) -> incl (snd P) (vids (verts x)).
Proof.
  revert P; induction x as [l vs|l vs x IHx y IHy]; cbn [leaves]; intros P I H.
  - destruct H as [<-|[]]. apply incl_refl.
  - destruct I as (O & Ix & Iy & _).
    assert (incl (vids (verts x)) (vids (verts (Node l vs x y))) /\
            incl (vids (verts y)) (vids (verts (Node l vs x y)))) as [L R].
    { destruct vs as [|v vs]; [|now apply O]. unfold vids.
      split; intros u Hu; apply in_map_iff in Hu as (w & <- & Hw); apply in_map, verts_in; auto. }
    apply in_app_or in H as [H|H].
    + eapply incl_tran; [apply IHx|]; eauto.
    + eapply incl_tran; [apply IHy|]; eauto.
Qed.

(** The vertices of a feature of a cell below [x] are resolved vertices of [x]. *)
Lemma feature_vertex x P S v : inv x -> In P (leaves x) -> incl S (snd P) -> In v S ->
  exists w, In w (verts x) /\ vid w = v /\ resolved w.
Proof.
  intros I L C Hv. apply C, (leaf_verts x P I L), in_map_iff in Hv as (w & <- & Hw).
  pose proof (proj1 (Forall_forall _ _) (inv_verts x I) w Hw). eauto.
Qed.

(** ** 6. One token *)

Lemma plane_side h a b d x P S t : (0 < d)%Z -> inv x -> In P (leaves x) -> incl S (snd P) ->
  forallb (fun w => inside h a b d (trail w)) (verts x) = true ->
  (IZR a <= t * IZR d <= IZR b)%R -> (IZR (tbeg s) <= t <= IZR (tend s))%R ->
  forall q, simplex s S t q -> (0 < valueR h t q)%R.
Proof.
  intros D I L C F A B q. apply hull_positive. intros p Hp.
  apply in_map_iff in Hp as (v & <- & Hv).
  destruct (feature_vertex x P S v I L C Hv) as (w & Hw & <- & E & W & _).
  pose proof (proj1 (forallb_forall _ _) F w Hw) as Aw. cbn beta in Aw. rewrite E in Aw.
  apply (inside_sound h a b d _ _ _ t D W Aw); tauto.
Qed.

Lemma wide_sound e n w : wide e n w = true ->
  (0 <= IZR w /\ IZR e * IZR e * dotR n (inj n) <= IZR w * IZR w)%R.
Proof.
  unfold wide. intros H. apply andb_true_iff in H as [A B]. apply Z.leb_le, IZR_le in A, B.
  now rewrite !mult_IZR, dot_IZR in B.
Qed.

Lemma plane_sound h w o a b d x y : (0 < d)%Z -> inv x -> inv y -> 
  apart_by_plane (least s o) h w a b d (verts x) (verts y) = true -> PairApart o a b d x y.
Proof.
  unfold apart_by_plane. intros D Ix Iy. destruct (wide _ _ _) eqn:W; [|discriminate].
  destruct (forallb _ (verts x)) eqn:Fx; [|discriminate]. intros Fy P Q HP HQ _. apply Apart_least. intros t A B S U IS IU p q HS HU.
  apply wide_sound in W as [W1 W2].
  pose proof (plane_side h a b d x P S t D Ix HP IS Fx A B p HS) as N1.
  pose proof (plane_side (behind h w) a b d y Q U t D Iy HQ IU Fy A B q HU) as N2.
  rewrite valueR_behind in N2. rewrite dist2_sym.
  apply (dist2_direction (normal h)). apply Rle_lt_trans with (1 := W2).
  apply Rmult_le_0_lt_compat; unfold valueR in *; lra.
Qed.

Lemma direction_sound n o a b d x y : (0 < d)%Z -> inv x -> inv y ->
  separated (tbeg s) (tend s) (least s o) n a b d (verts x) (verts y) = true ->
  PairApart o a b d x y.
Proof.
  intros D Ix Iy. unfold separated. set (e := least s o) in *. set (k := (e * e * dot n n)%Z). cbv zeta.
  set (hw := plane_between _ _ _ _ _ _ _). intros F.
  destruct (apart_by_plane e (fst hw) (snd hw) a b d (verts x) (verts y)) eqn:E.
  { now apply (plane_sound (fst hw) (snd hw)). }
  assert (empty (verts x) || empty (verts y) || apart_by_bounds (tbeg s) (tend s) k n a b d (verts x) (verts y)
    || apart_by_walk k n a b d (verts x) (verts y) = true)%bool as F'.
  { destruct (empty _ || empty _)%bool; [reflexivity|]. now destruct (apart_by_bounds _ _ _ _ _ _ _ _ _). }
  intros P Q HP HQ _. apply Apart_least. intros t A B S U IS IU p q HS HU.
  assert (0 <= IZR k)%R as K by (apply IZR_le; unfold k, dot; nia).
  assert (forall m, below_root k m -> dotR n q + m < dotR n p)%R as G.
  2:{ pose proof (G 0%R) as G0. rewrite dist2_sym. apply (dist2_direction n).
      replace (_ * _)%R with (IZR k) by (unfold k; now rewrite !mult_IZR, dot_IZR).
      assert (dotR n q + 0 < dotR n p)%R by (apply G0; split; lra). apply Rnot_le_lt. intros L.
      assert (dotR n q + (dotR n p - dotR n q) < dotR n p)%R by (apply G; split; lra). lra. }
  intros m M. refine (hull_apart n _ _ _ q p _ HU HS). intros p1 p2 H1 H2.
  apply in_map_iff in H1 as (v1 & <- & H1), H2 as (v2 & <- & H2).
  destruct (feature_vertex y Q U v1 Iy HQ IU H1) as (w1 & I1 & <- & W1).
  destruct (feature_vertex x P S v2 Ix HP IS H2) as (w2 & I2 & <- & W2).
  apply (further_sound k m n a b d bits (tbeg s) (tend s) (path s) (verts x) (verts y)); auto.
  pose proof (inv_verts x Ix) as Fx. pose proof (inv_verts y Iy) as Fy.
  rewrite Forall_forall in Fx, Fy. intros u [Hu|Hu]; [apply Fx in Hu|apply Fy in Hu]; apply Hu.
Qed.

(** The label of a node is that of all its cells. *)
Lemma label_sound x l : inv x -> label_of x = Some l -> forall P, In P (leaves x) -> fst P = l.
Proof.
  induction x as [m vs|m vs x IHx y IHy]; cbn; intros I E P H.
  - injection E as ->. destruct H as [<-|[]]. reflexivity.
  - destruct I as (_ & Ix & Iy & L). destruct (L l E).
    apply in_app_or in H as [H|H]; auto.
Qed.

Lemma excluded_pair_sound l m : excluded_pair s l m = true -> is_excluded s l m.
Proof.
  unfold excluded_pair, is_excluded. rewrite existsb_exists. intros ((p, q) & I & E). cbn in E.
  apply orb_true_iff in E as [E|E]; apply andb_true_iff in E as [E1 E2];
    apply Z.eqb_eq in E1, E2; subst; auto.
Qed.

Lemma excluded_sound o a b d x y : inv x -> inv y ->
  excluded_labels s (label_of x) (label_of y) = true -> PairApart o a b d x y.
Proof.
  intros Ix Iy E P Q HP HQ N. exfalso. apply N. unfold excluded_labels in E.
  destruct (label_of x) as [l|] eqn:Lx; [|discriminate].
  destruct (label_of y) as [m|] eqn:Ly; [|discriminate].
  rewrite (label_sound x l), (label_sound y m); auto. now apply excluded_pair_sound.
Qed.

Lemma both_sound o a b d x : PairApart o a b d x x -> SelfApart o a b d x.
Proof.
  induction x as [l vs|l vs x IHx y IHy]; cbn; intros H.
  - intros _. apply H; cbn; auto.
  - split; [apply IHx|split; [|apply IHy]]; intros P Q HP HQ; apply H; cbn; apply in_or_app; auto.
Qed.

Lemma self_halves o a b d x :
  SelfApart o (a + a) (a + b) (d + d) x -> SelfApart o (a + b) (b + b) (d + d) x -> SelfApart o a b d x.
Proof.
  induction x as [l vs|l vs x IHx y IHy]; cbn.
  - intros H1 H2 E. apply Claimed_halves; auto.
  - intros (A1 & A2 & A3) (B1 & B2 & B3). split; [|split]; auto.
    intros P Q HP HQ. apply Claimed_halves; [apply A2|apply B2]; auto.
Qed.

Ltac heads F := repeat match type of F with
  | Forall _ (_ :: _) => let H := fresh "H" in apply Forall_inv in F as H; apply Forall_inv_tail in F
  end.

Ltac on_forallb l F := match goal with
  | |- context [forallb ?f l] => destruct (forallb f l) eqn:F; [|discriminate]
  end.

(** If what a token leaves holds, so did what it found. *)
Lemma step_pair_sound x y o a b d k tok st' :
  step_pair s x y o a b d k tok = Some st' -> Forall holds st' -> Forall holds (Pair x y o a b d :: k).
Proof.
  destruct tok as [| | |i|v ws| |h w|n| | | |]; cbn [step_pair]; try discriminate.
  - (* THalve *)
    destruct (d <? d_max)%Z; [|discriminate]. intros [= <-] F. heads F. constructor; auto.
    cbn [holds] in *. intros D Ix Iy P Q HP HQ. apply Claimed_halves; [apply H|apply H0]; auto; lia.
  - (* TLeft *)
    destruct x as [|l vs x1 x2]; [discriminate|]. intros [= <-] F. heads F. constructor; auto.
    cbn in *. intros D (? & I1 & I2 & _) Iy P Q HP HQ.
    apply in_app_or in HP as [HP|HP]; [apply H|apply H0]; auto.
  - (* TRight *)
    destruct y as [|l vs y1 y2]; [discriminate|]. intros [= <-] F. heads F. constructor; auto.
    cbn in *. intros D Ix (? & I1 & I2 & _) P Q HP HQ.
    apply in_app_or in HQ as [HQ|HQ]; [apply H|apply H0]; auto.
  - (* TDrop *)
    destruct x as [l p|]; [|discriminate]. destruct y as [m q|]; [|discriminate].
    destruct (nth_id _ _) as [v|]; [|discriminate]. intros [= <-] F. heads F. constructor; auto.
    cbn in *. intros D Ix Iy P Q [<-|[]] [<-|[]] E. cbn in *.
    apply Apart_drop with v; rewrite <- without_ids.
    + apply (H D (inv_filter _ p Ix) Iy (l, vids (without v p)) (m, vids q)); cbn; auto.
    + apply (H0 D Ix (inv_filter _ q Iy) (l, vids p) (m, vids (without v q))); cbn; auto.
  - (* TRing *)
    destruct x as [l p|]; [|discriminate]. destruct y as [m q|]; [|discriminate].
    destruct (way_ends _ _ _ _) as [us|] eqn:W; [|discriminate].
    destruct (_ && _)%bool; [|discriminate]. cbn zeta.
    assert (Forall resolved p -> Forall resolved q -> (0 < d)%Z ->
      holds (Pair (Leaf l (without v p)) (Leaf m q) Far a b d) ->
      holds (Pair (Leaf l p) (Leaf m (without_all us q)) Far a b d) ->
      PairApart Far a b d (Leaf l p) (Leaf m q)) as R.
    { intros Ix Iy D H H0. cbn in *. intros P Q [<-|[]] [<-|[]] E. cbn in *.
      apply Apart_ring with us v.
      + intros u Hu. now apply (way_ends_sound ws _ _ us).
      + rewrite <- without_ids.
        apply (H D (inv_filter _ p Ix) Iy (l, vids (without v p)) (m, vids q)); cbn; auto.
      + rewrite <- without_all_ids.
        apply (H0 D Ix (inv_filter _ q Iy) (l, vids p) (m, vids (without_all us q))); cbn; auto. }
    assert (forall x y, holds (Pair x y Distance a b d) -> holds (Pair x y Far a b d)) as R'.
    { intros x y H D Ix Iy P Q HP HQ E. apply Apart_far. now apply H. }
    destruct o; [| |discriminate]; intros [= <-] F; heads F; constructor; auto; intros D Ix Iy.
    + intros P Q HP HQ E. apply Apart_parts; [apply R|apply H1]; auto.
    + apply R; auto.
  - (* TFar *)
    destruct o; [|discriminate|discriminate]. intros [= <-] F. heads F. constructor; auto.
    cbn [holds] in *. intros D Ix Iy P Q HP HQ E. apply Apart_parts; [apply H|apply H0]; auto.
  - (* TPlane *)
    destruct (apart_by_plane _ _ _ _ _ _ _ _) eqn:E; [|discriminate].
    intros [= <-] F. constructor; auto. intros D Ix Iy. eapply plane_sound; eauto.
  - (* TDirection *)
    destruct (separated _ _ _ _ _ _ _ _ _) eqn:E; [|discriminate].
    intros [= <-] F. constructor; auto. intros D Ix Iy. eapply direction_sound; eauto.
  - (* TExcluded *)
    destruct (excluded_labels _ _ _) eqn:E; [|discriminate].
    intros [= <-] F. constructor; auto. intros D Ix Iy. now apply excluded_sound.
Qed.

Lemma step_self_sound x o a b d k tok st' :
  step_self strict s x o a b d k tok = Some st' -> Forall holds st' -> Forall holds (Self x o a b d :: k).
Proof.
  destruct tok as [| | |i|v ws| |h w|n| | | |]; cbn [step_self]; try discriminate.
  - (* THalve *)
    destruct (d <? d_max)%Z; [|discriminate]. intros [= <-] F. heads F. constructor; auto.
    cbn [holds] in *. intros D I. apply self_halves; [apply H|apply H0]; auto; lia.
  - (* TExcluded *)
    destruct (excluded_labels _ _ _) eqn:E; [|discriminate].
    intros [= <-] F. constructor; auto. intros D I. now apply both_sound, excluded_sound.
  - (* TParts *)
    destruct x as [|l vs x y]; [discriminate|]. intros [= <-] F. heads F. constructor; auto.
    cbn in *. tauto.
  - (* TOne *)
    destruct x as [l vs|]; [|discriminate]. destruct strict eqn:E; [discriminate|].
    intros [= <-] F. constructor; auto. cbn. now rewrite E.
  - (* TBoth *)
    intros [= <-] F. heads F. constructor; auto. cbn in *. intros. apply both_sound; auto.
Qed.

Lemma step_sound st tok st' : step strict s st tok = Some st' -> Forall holds st' -> Forall holds st.
Proof.
  destruct st as [|[x y o a b d|x o a b d] k]; cbn [step]; [discriminate| |];
    [apply step_pair_sound|apply step_self_sound].
Qed.

Lemma run_sound toks : forall st st',
  run strict s st toks = Some st' -> Forall holds st' -> Forall holds st.
Proof.
  induction toks as [|tok r IH]; cbn [run]; intros st st'.
  - now intros [= <-].
  - destruct (step strict s st tok) as [st1|] eqn:E; [|discriminate].
    intros R F. eapply step_sound; eauto.
Qed.

(** Streaming: the tokens may be run piece by piece. *)
Lemma run_app l1 l2 : forall st, run strict s st (l1 ++ l2) =
  match run strict s st l1 with Some st' => run strict s st' l2 | None => None end.
Proof.
  induction l1 as [|tok r IH]; cbn [run app]; auto. intros st.
  now destruct (step strict s st tok).
Qed.

(** ** 7. The tree *)
Arguments union : simpl never.

Lemma union_acc_cons {A} (key : A -> Z) x r1 y r2 acc :
  union_acc key (x :: r1) (y :: r2) acc =
    if (key x <? key y)%Z then union_acc key r1 (y :: r2) (x :: acc)
    else if (key y <? key x)%Z then union_acc key (x :: r1) r2 (y :: acc)
    else union_acc key r1 r2 (x :: acc).
Proof. reflexivity. Qed.

Lemma union_acc_in {A} (key : A -> Z) : forall l1 l2 acc w,
  In w (union_acc key l1 l2 acc) -> In w acc \/ In w l1 \/ In w l2.
Proof.
  induction l1 as [|x r1 IH1].
  { cbn; intros l2 acc w. rewrite rev_append_in. tauto. }
  induction l2 as [|y r2 IH2]; intros acc w.
  { cbn. rewrite rev_append_in. cbn; tauto. }
  rewrite union_acc_cons.
  destruct (_ <? _)%Z; [|destruct (_ <? _)%Z]; intros H;
    [apply IH1 in H|apply IH2 in H|apply IH1 in H]; cbn in *; tauto.
Qed.

Lemma union_acc_keys {A} (key : A -> Z) : forall l1 l2 acc v,
  In v (map key acc) \/ In v (map key l1) \/ In v (map key l2) -> In v (map key (union_acc key l1 l2 acc)).
Proof.
  induction l1 as [|x r1 IH1].
  { cbn; intros l2 acc v. rewrite !in_map_iff.
    intros [(w & E & H)|[[]|(w & E & H)]]; exists w; rewrite rev_append_in; auto. }
  induction l2 as [|y r2 IH2]; intros acc v.
  { cbn [union_acc]. rewrite !in_map_iff.
    intros [(w & E & H)|[(w & E & H)|(w & E & [])]]; exists w; rewrite rev_append_in; auto. }
  rewrite union_acc_cons.
  destruct (_ <? _)%Z eqn:E1; [|destruct (key y <? key x)%Z eqn:E2]; intros H;
    [apply IH1|apply IH2|apply IH1]; cbn in *; try tauto.
  assert (key x = key y) by (apply Z.ltb_ge in E1, E2; lia). intuition congruence.
Qed.

Lemma union_in {A} (key : A -> Z) l1 l2 w : In w (union key l1 l2) -> In w l1 \/ In w l2.
Proof. intros H; apply union_acc_in in H; cbn in H; tauto. Qed.

Lemma union_keys {A} (key : A -> Z) l1 l2 v :
  In v (map key l1) \/ In v (map key l2) -> In v (map key (union key l1 l2)).
Proof. intros H; apply union_acc_keys; tauto. Qed.

Fixpoint ids (g : group) : list Z :=
  match g with Cell i => [i] | Join l r => ids l ++ ids r end.

Lemma ids_of_in g : forall i, In i (ids_of g) -> In i (ids g).
Proof.
  induction g as [j|l IHl r IHr]; cbn; intros i; auto.
  intros H; apply union_in in H as [H|H]; apply in_or_app; auto.
Qed.

Lemma is_range_sound n l : forall k, is_range k n l = true -> forall i, (k <= i < n)%Z -> In i l.
Proof.
  induction l as [|x r IH]; cbn; intros k H i Hi.
  - apply Z.eqb_eq in H. lia.
  - apply andb_true_iff in H as [E H]. apply Z.eqb_eq in E as ->.
    destruct (Z.eq_dec k i); auto. right. apply (IH (k + 1)%Z); auto. lia.
Qed.

Lemma covers_sound n g i : covers n g = true -> (0 <= i < n)%Z -> In i (ids g).
Proof.
  intros C Hi. apply andb_true_iff in C as [_ C]. now apply ids_of_in, (is_range_sound _ _ _ C).
Qed.

Lemma cell_ids_in f i v : In v (cell s i) -> In (f v) (cell_ids f s i).
Proof.
  unfold cell_ids; induction (cell s i) as [|u l IH]; cbn; [easy|]. intros H.
  rewrite <- (map_id (union _ _ _)). apply union_keys. cbn. destruct H as [<-|H]; auto.
  right. rewrite map_id. auto.
Qed.

Lemma cell_ids_from f i v : In v (cell_ids f s i) -> exists u, In u (cell s i) /\ f u = v.
Proof.
  unfold cell_ids; induction (cell s i) as [|u l IH]; cbn; [easy|]. intros H.
  apply union_in in H as [[<-|[]]|H]; eauto. destruct (IH H) as (w & I & E); eauto.
Qed.

Lemma group_ids_in f g i v : In i (ids g) -> In v (cell_ids f s i) -> In v (group_ids f s g).
Proof.
  induction g as [j|l IHl r IHr]; cbn; intros H V.
  - now destruct H as [<-|[]].
  - rewrite <- (map_id (union _ _ _)). apply union_keys. rewrite !map_id. apply in_app_or in H as [H|H]; auto.
Qed.

Lemma group_ids_from f g v : In v (group_ids f s g) -> exists i, In i (ids g) /\ In v (cell_ids f s i).
Proof.
  induction g as [j|l IHl r IHr]; cbn.
  - exists j; auto.
  - intros H. apply union_in in H as [H|H]; [apply IHl in H|apply IHr in H];
      destruct H as (i & I & V); exists i; split; auto; apply in_or_app; auto.
Qed.

Definition sensible (v : Z) : Prop :=
  covers_time (tbeg s) (tend s) (path s v) /\ path s (same s v) = path s v.

Lemma wf_vertex_sound v : wf_vertex s v = true -> sensible v.
Proof.
  unfold wf_vertex. rewrite andb_true_iff, orb_true_iff, Z.eqb_eq. intros [W E].
  apply wf_traj_sound in W. split; auto. destruct E as [->|E]; auto. now apply equal_traj_sound.
Qed.

Lemma vertices_sound l : (forall v, In v l -> covers_time (tbeg s) (tend s) (path s v)) ->
  forall acc, Forall (sorted_in resolved vid) acc -> Forall (sorted_in resolved vid) (vertices (vertex_of s bits) l acc).
Proof.
  induction l as [|v l IH]; cbn [vertices]; intros C acc F.
  - rewrite rev_append_rev, app_nil_r. now apply Forall_rev.
  - apply IH; [intros; apply C; now right|]. constructor; auto. repeat split. cbn. apply C. now left.
Qed.

Lemma look_up_all_sound table l : each resolved table -> forall vs, look_up_all table l = Some vs ->
  map vid vs = l /\ Forall resolved vs.
Proof.
  intros T; induction l as [|v l IH]; cbn [look_up_all]; intros vs.
  - intros [= <-]. auto.
  - unfold look_up. apply (find_each _ (fun k => k <=? v)%Z) in T as W. set (w := find _ _) in *.
    destruct (Z.eqb_spec (vid w) v) as [E|]; [|discriminate].
    destruct (look_up_all table l) as [l'|]; [|discriminate]. intros [= <-].
    destruct (IH _ eq_refl). cbn. split; [congruence|auto].
Qed.

Section Table.
Variable table : search vertex.
Hypothesis table_resolved : each resolved table.

Lemma build_cell i x : build_from table s (Cell i) = Some x ->
  exists vs, x = Leaf (label s i) vs /\ map vid vs = cell_ids (same s) s i /\ Forall resolved vs.
Proof.
  cbn [build_from]. destruct (look_up_all _ _) as [vs|] eqn:E; [|discriminate]. intros [= <-].
  apply look_up_all_sound in E as [E R]; eauto.
Qed.

Lemma build_inv g : forall x, build_from table s g = Some x -> inv x.
Proof.
  induction g as [i|l IHl r IHr]; intros x B.
  - apply build_cell in B as (vs & -> & _ & R). exact R.
  - cbn in B. destruct (build_from table s l) as [xl|]; [|discriminate].
    destruct (build_from table s r) as [xr|]; [|discriminate]. injection B as <-. cbn.
    pose proof (IHl _ eq_refl) as L. pose proof (IHr _ eq_refl) as R.
    pose proof (inv_verts _ L) as VL. pose proof (inv_verts _ R) as VR.
    split; [|split; [|split]]; auto.
    + unfold few_of. destruct (own xl) as [|u p] eqn:P; [easy|]. destruct (own xr) as [|v q] eqn:Q; [easy|].
      rewrite <- P, <- Q. destruct (at_most _ _); [|easy]. intros _.
      assert (verts xl = own xl /\ verts xr = own xr) as [-> ->].
      { split; [destruct xl as [|? [|]]|destruct xr as [|? [|]]]; easy. }
      replace (verts xl) with (own xl) in VL by (destruct xl as [|? [|]]; easy).
      replace (verts xr) with (own xr) in VR by (destruct xr as [|? [|]]; easy).
      rewrite Forall_forall in VL, VR |- *. split; [|split].
      * intros w H; apply union_in in H as [H|H]; [now apply VL|now apply VR].
      * intros w Hw; apply union_keys; auto.
      * intros w Hw; apply union_keys; auto.
    + unfold common_label. intros m.
      destruct (label_of xl) as [a|], (label_of xr) as [b|]; try discriminate.
      destruct (Z.eqb_spec a b); [|discriminate]. subst. now intros [= <-].
Qed.

Definition leaf_of i := (label s i, cell_ids (same s) s i).

Lemma build_leaves g : forall x, build_from table s g = Some x -> leaves x = map leaf_of (ids g).
Proof.
  induction g as [i|l IHl r IHr]; intros x B.
  - apply build_cell in B as (vs & -> & E & _). unfold leaf_of. cbn. now rewrite E.
  - cbn in B. destruct (build_from table s l) as [xl|]; [|discriminate].
    destruct (build_from table s r) as [xr|]; [|discriminate]. injection B as <-. cbn.
    now rewrite (IHl _ eq_refl), (IHr _ eq_refl), map_app.
Qed.

(** A tree has every pair of its cells. *)
Lemma self_pairs o a b d g : forall x, build_from table s g = Some x -> SelfApart o a b d x ->
  forall i j, In i (ids g) -> In j (ids g) -> strict = true \/ i <> j ->
  Claimed o a b d (leaf_of i) (leaf_of j).
Proof.
  induction g as [f|l IHl r IHr]; intros x Bx.
  - apply build_cell in Bx as (vs & -> & E & _). intros H i j [<-|[]] [<-|[]] [N|N]; [|congruence].
    unfold leaf_of. rewrite <- E. now apply H.
  - cbn in Bx. destruct (build_from table s l) as [xl|] eqn:L; [|discriminate].
    destruct (build_from table s r) as [xr|] eqn:R; [|discriminate].
    injection Bx as <-. cbn. intros (A & B & C) i j Hi Hj N.
    unfold PairApart in B. rewrite (build_leaves _ _ L), (build_leaves _ _ R) in B.
    assert (I : forall k g', In k (ids g') -> In (leaf_of k) (map leaf_of (ids g'))).
    { intros k g'. apply (in_map leaf_of). }
    apply in_app_or in Hi as [Hi|Hi]; apply in_app_or in Hj as [Hj|Hj].
    + eapply IHl; eauto.
    + apply B; auto.
    + apply Claimed_sym, B; auto.
    + eapply IHr; eauto.
Qed.

End Table.

(** A scene with a tree has vertices as they should be. *)
Lemma build_sound g x : bits = bits_of s g -> build s g = Some x ->
  (forall i v, In i (ids g) -> In v (cell s i) -> sensible v) /\
  exists table, each resolved table /\ build_from table s g = Some x.
Proof.
  intros Eb. unfold build, build_by. on_forallb (group_ids (fun v => v) s g) F. cbn zeta.
  change (unit_bits _ _) with (bits_of s g). rewrite <- Eb.
  assert (forall i v, In i (ids g) -> In v (cell s i) -> sensible v) as C.
  { intros i v Hi Hv. rewrite forallb_forall in F. apply wf_vertex_sound, F, (group_ids_in _ g i); auto.
    now apply (cell_ids_in (fun u => u)). }
  destruct (join_all _ _) as [table|] eqn:E; [|discriminate]. intros B. split; auto.
  exists table. split; auto. apply (join_all_sound resolved vid) in E as [E _]; auto.
  apply vertices_sound; auto. intros v Hv.
  apply group_ids_from in Hv as (i & Hi & Hv). apply cell_ids_from in Hv as (u & Hu & <-).
  destruct (C i u Hi Hu) as [W ->]. exact W.
Qed.

(** A feature is where the vertices that stand for its own are. *)
Lemma simplex_same i P t : (forall v, In v (cell s i) -> sensible v) -> incl P (cell s i) ->
  simplex s (map (same s) P) t = simplex s P t.
Proof.
  intros C I. unfold simplex. f_equal. rewrite map_map. apply map_ext_in. intros v Hv.
  destruct (C v (I v Hv)) as [_ ->]. reflexivity.
Qed.

Lemma start_sound g st : bits = bits_of s g -> start s g = Some st ->
  well_formed s /\ (Forall holds st -> never_touch strict s).
Proof.
  intros Eb. unfold start, start_by. destruct (_ && _)%bool eqn:E; [|discriminate].
  rewrite !andb_true_iff in E. destruct E as [[[[E0 E1] E2] E3] C].
  apply Z.ltb_lt in E0, E1, E3. apply Z.leb_le in E2. destruct (build s g) as [x|] eqn:B; [|discriminate].
  apply (build_sound _ _ Eb) in B as (W & table & R & B).
  intros [= <-]. split.
  - do 4 (split; auto). intros i v Hi Hv. apply (W i); auto. now apply covers_sound with (ncell s).
  - intros F. apply Forall_inv in F as S. cbn [holds] in S.
    specialize (S eq_refl (build_inv table R g x B)).
    intros t Ht i j Hi Hj D N P Q IP IQ x1 x2 H1 H2. cbn zeta.
    assert (I : forall k T, incl T (cell s k) -> incl (map (same s) T) (cell_ids (same s) s k)).
    { intros k T HT v Hv. apply in_map_iff in Hv as (u & <- & Hu). now apply cell_ids_in, HT. }
    rewrite <- (simplex_same i) in H1; [| |exact IP]; [|intros v; apply W; eauto using covers_sound].
    rewrite <- (simplex_same j) in H2; [| |exact IQ]; [|intros v; apply W; eauto using covers_sound].
    assert (Apart (if (0 <? eta s)%Z then Distance else Disjoint) (tbeg s) (tend s) 1
              (cell_ids (same s) s i) (cell_ids (same s) s j)) as A.
    { apply (self_pairs table R _ _ _ _ g x B S i j); eauto using covers_sound. }
    destruct (A t) with (S := map (same s) P) (U := map (same s) Q) (x := x1) (y := x2) as [A1 A2];
      auto; [lra|].
    destruct (0 <? eta s)%Z eqn:E.
    + split; [apply A1|apply A2]; discriminate.
    + apply Z.ltb_ge in E. assert (eta s = 0)%Z as -> by lia. split; [apply A1; discriminate|].
      intros A3. rewrite pow_i by lia. apply A1; [discriminate|]. now apply far_disjoint.
Qed.
End Soundness.

(** ** The theorems *)

(** What the checker accepts is true. *)
Theorem check_sound strict s g toks : check strict s g toks = true -> never_touch strict s.
Proof.
  unfold check. destruct (start s g) as [st|] eqn:E; [|discriminate].
  destruct (run _ _ _ _) as [[|]|] eqn:R; try discriminate. intros _.
  apply (start_sound s strict (bits_of s g)) in E as [_ H]; auto. apply H.
  apply (run_sound s strict (bits_of s g)) in R; auto. apply bits_of_least.
Qed.

(** It is said of no scene that makes no sense. *)
Theorem check_well_formed strict s g toks : check strict s g toks = true -> well_formed s.
Proof.
  unfold check. destruct (start s g) as [st|] eqn:E; [|discriminate]. intros _.
  now apply (start_sound s strict (bits_of s g)) in E.
Qed.

(** What is true of strict claims is true of others. *)
Lemma never_touch_weaken s : never_touch true s -> never_touch false s.
Proof. intros H t Ht i j Hi Hj _. apply H; auto. Qed.

(** The same for two cells, which may be edges or points, that share no vertex: they
    have no point in common. *)
Corollary check_sound_cells strict s g toks : check strict s g toks = true ->
  forall t, (IZR (tbeg s) <= t <= IZR (tend s))%R ->
  forall i j, (0 <= i < ncell s)%Z -> (0 <= j < ncell s)%Z ->
  ~ is_excluded s (label s i) (label s j) ->
  disjoint_ids (map (same s) (cell s i)) (map (same s) (cell s j)) ->
  forall x, ~ (simplex s (cell s i) t x /\ simplex s (cell s j) t x).
Proof.
  intros H t Ht i j Hi Hj E D x [X Y].
  destruct (Z.eq_dec i j) as [<-|N].
  - destruct (cell s i) as [|v l]; [now apply hull_nil in X|]. apply (D (same s v)); now left.
  - destruct (check_sound _ _ _ _ H t Ht i j Hi Hj (or_intror N) E _ _ (incl_refl _) (incl_refl _) x x X Y)
      as [A _].
    specialize (A D). unfold dist2 in A. lra.
Qed.
