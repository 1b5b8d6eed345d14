(* SPDX-License-Identifier: Apache-2.0 *)
(** * The opposite verdict: a witness that two cells do touch, or come near

    A witness names a time, two cells, and for each of them some of its vertices with
    weights; the two weighted means are at most [eta] apart (so if [eta] is 0, they are
    the same point).  Its checker is integers
    only, like Checker.v, and [check_hit_sound] says that what it accepts is true.

    Notation: [c/d] is the time; a weight is an integer, to be divided by the sum of
    all weights of its side.

    Not here: times that are roots of polynomials and not rational, and that a
    contact is the first. *)
Require Import ZArith List Bool Reals Lra Lia.
From Noli Require Import Spec Checker Sound.
Import ListNotations.
Open Scope Z_scope.

(** ** The checker *)

Record witness := Witness {
  wc : Z; wd : Z;           (* the time is wc/wd          *)
  wi : Z; wj : Z;           (* the cells                  *)
  wp : list (Z * Z);        (* vertices of wi and weights *)
  wq : list (Z * Z)         (* vertices of wj and weights *)
}.

(** How far a trajectory is in direction [n] at the time [c/d]. *)
Definition value_at (n : vec) (c d : Z) (tr : traj) : option rat :=
  match since d c (index tr) with
  | [] => None
  | (t0, p0) :: r =>
      match r with
      | [] => if c =? t0 * d then Some (dot n p0, 1) else None
      | (t1, p1) :: _ =>
          if c <=? t1 * d then Some (between (t0 * d) (dot n p0) (t1 * d) (dot n p1) c) else None
      end
  end.

Definition rat_add (q r : rat) : rat :=
  if snd q =? snd r then (fst q + fst r, snd q) else (fst q * snd r + fst r * snd q, snd q * snd r).

(** The sum of weights. *)
Fixpoint total (l : list (Z * Z)) : Z :=
  match l with [] => 0 | x :: r => snd x + total r end.

(** The sum of values, each times its weight. *)
Fixpoint moment (s : scene) (n : vec) (c d : Z) (l : list (Z * Z)) : option rat :=
  match l with
  | [] => Some (0, 1)
  | x :: r =>
      match value_at n c d (path s (fst x)), moment s n c d r with
      | Some q, Some m => Some (rat_add (snd x * fst q, snd q) m)
      | _, _ => None
      end
  end.

(** The square of the difference of the two means in direction [n]. *)
Definition square_in (s : scene) (w : witness) (n : vec) : option rat :=
  match moment s n (wc w) (wd w) (wp w), moment s n (wc w) (wd w) (wq w) with
  | Some p, Some q =>
      let g := fst p * total (wq w) * snd q - fst q * total (wp w) * snd p in
      let h := snd p * total (wp w) * (snd q * total (wq w)) in
      Some (g * g, h * h)
  | _, _ => None
  end.

(** The two means are at most [eta] apart. *)
Definition near (s : scene) (w : witness) : bool :=
  match square_in s w (V3 1 0 0), square_in s w (V3 0 1 0), square_in s w (V3 0 0 1) with
  | Some x, Some y, Some z =>
      let q := rat_add x (rat_add y z) in fst q <=? eta s * eta s * snd q
  | _, _, _ => false
  end.

Definition member (v : Z) (l : list Z) : bool := existsb (fun u => v =? u) l.

Definition side_ok (s : scene) (i : Z) (l : list (Z * Z)) : bool :=
  (0 <=? i) && (i <? ncell s) && (0 <? total l) &&
  forallb (fun x => (0 <=? snd x) && member (fst x) (cell s i) &&
                    wf_traj (tbeg s) (tend s) (path s (fst x))) l.

Definition check_hit (strict : bool) (s : scene) (w : witness) : bool :=
  (tbeg s <? tend s) && (0 <? wd w) && (tbeg s * wd w <=? wc w) && (wc w <=? tend s * wd w) &&
  (strict || negb (wi w =? wj w)) && side_ok s (wi w) (wp w) && side_ok s (wj w) (wq w) &&
  negb (excluded_pair s (label s (wi w)) (label s (wj w))) &&
  forallb (fun x => forallb (fun y => negb (same s (fst x) =? same s (fst y))) (wq w)) (wp w) &&
  (ring s =? 1) && near s w.

(** ** Its soundness *)
Open Scope R_scope.

Lemma value_at_sound n c d T0 T1 tr q : (0 < d)%Z -> covers_time T0 T1 tr -> (T0 * d <= c)%Z ->
  value_at n c d tr = Some q -> proper q /\ ratR q = far n tr (IZR c / IZR d).
Proof.
  destruct tr as [|(t0, p0) r]; [easy|]. intros D (L & W & _) C A.
  destruct (since_sound d c r D t0 p0 W) as (t0' & p0' & r' & E & I & _ & P).
  unfold value_at in A. rewrite E in A. apply IZR_lt in D as D'.
  assert (IZR c / IZR d * IZR d = IZR c) as X by (field; lra).
  destruct (P (IZR c / IZR d)) as [_ P']; [|lra|].
  { apply (Rmult_le_reg_r (IZR d)); auto. rewrite X, <- mult_IZR. apply IZR_le. nia. }
  unfold far; cbn [pos]. rewrite P'. destruct r' as [|(t1, p1) r'].
  - destruct (c =? t0' * d)%Z; [|discriminate]. injection A as <-. split; [easy|].
    unfold ratR. cbn [fst snd pos_from]. rewrite <- dot_IZR. field.
  - destruct (c <=? t1 * d)%Z eqn:E1; [|discriminate]. injection A as <-.
    apply between_sound; auto; [apply IZR_lt, I|]. now apply IZR_le, Z.leb_le.
Qed.

Lemma rat_add_sound q r : proper q -> proper r ->
  proper (rat_add q r) /\ ratR (rat_add q r) = ratR q + ratR r.
Proof.
  unfold proper, rat_add, ratR; intros Q P. destruct (_ =? _)%Z eqn:E; cbn [fst snd].
  - apply Z.eqb_eq in E. split; auto. rewrite E in *. rewrite plus_IZR. field. apply IZR_lt in Q; lra.
  - split; [nia|]. rewrite plus_IZR, !mult_IZR. apply IZR_lt in Q, P. field; lra.
Qed.

(** The vertices' points, and their weights. *)
Definition points (s : scene) (t : R) (l : list (Z * Z)) : list pt :=
  map (fun v => pos (path s v) t) (map fst l).
Definition weights (W : R) (l : list (Z * Z)) : list R := map (fun x => IZR (snd x) / W) l.

Lemma moment_sound s n c d W l : (0 < d)%Z -> (tbeg s * d <= c)%Z -> W <> 0 ->
  (forall x, In x l -> covers_time (tbeg s) (tend s) (path s (fst x))) ->
  forall m, moment s n c d l = Some m ->
  proper m /\ ratR m / W = dotR n (comb (weights W l) (points s (IZR c / IZR d) l)).
Proof.
  intros D C N. induction l as [|x l IH]; intros H m M.
  - injection M as <-. split; [easy|]. unfold ratR, dotR, weights, points. cbn [map comb px py pz fst snd]. field; auto.
  - cbn [moment] in M. destruct (value_at _ _ _ _) as [q|] eqn:E; [|discriminate].
    destruct (moment s n c d l) as [k|]; [|discriminate]. injection M as <-.
    eapply value_at_sound in E as [P V]; eauto; [|apply H; now left].
    destruct (IH (fun y I => H y (or_intror I)) k eq_refl) as [Pk Vk].
    destruct (rat_add_sound (snd x * fst q, snd q) k)%Z as [Pm Vm]; auto.
    split; auto. rewrite Vm.
    replace (dotR n _) with (IZR (snd x) / W * far n (path s (fst x)) (IZR c / IZR d) + ratR k / W)
      by (rewrite Vk; unfold far, dotR, weights, points; cbn [map comb px py pz]; ring).
    rewrite <- V. unfold ratR at 1 3; cbn [fst snd]. rewrite mult_IZR. apply IZR_lt in P. field. lra.
Qed.

Lemma member_in v l : member v l = true -> In v l.
Proof. unfold member; rewrite existsb_exists. intros (u & I & E). apply Z.eqb_eq in E; now subst. Qed.

Lemma total_weights W l : W <> 0 -> sum (weights W l) * W = IZR (total l).
Proof.
  intros N; unfold weights; induction l as [|x l IH]; cbn; [lra|].
  rewrite plus_IZR, <- IH. field; auto.
Qed.

Lemma side_sound s i l t : side_ok s i l = true ->
  (0 <= i < ncell s)%Z /\ 0 < IZR (total l) /\ incl (map fst l) (cell s i) /\
  (forall x, In x l -> covers_time (tbeg s) (tend s) (path s (fst x))) /\
  simplex s (map fst l) t (comb (weights (IZR (total l)) l) (points s t l)).
Proof.
  unfold side_ok; rewrite !andb_true_iff, forallb_forall. intros [[[L U] T] F].
  apply Z.leb_le in L; apply Z.ltb_lt in U, T. apply IZR_lt in T.
  assert (forall x, In x l -> (0 <= snd x)%Z /\ In (fst x) (cell s i) /\
          covers_time (tbeg s) (tend s) (path s (fst x))) as A.
  { intros x Hx. apply F in Hx. rewrite !andb_true_iff in Hx. destruct Hx as [[X1 X2] X3].
    apply Z.leb_le in X1. apply member_in in X2. apply wf_traj_sound in X3. auto. }
  repeat split; auto.
  - intros v Hv; apply in_map_iff in Hv as (x & <- & Hx). now apply A.
  - intros x Hx. now apply A.
  - exists (weights (IZR (total l)) l). repeat split.
    + unfold weights. now rewrite !map_length.
    + apply Forall_forall; intros a Ha. unfold weights in Ha. apply in_map_iff in Ha as (x & <- & Hx).
      apply Rmult_le_pos; [apply IZR_le; now apply A|]. apply Rlt_le, Rinv_0_lt_compat; auto.
    + apply (Rmult_eq_reg_r (IZR (total l))); [|lra]. rewrite total_weights; lra.
Qed.

Lemma excluded_pair_complete s l m : is_excluded s l m -> excluded_pair s l m = true.
Proof.
  unfold excluded_pair, is_excluded. rewrite existsb_exists.
  intros [I|I]; [exists (l, m)|exists (m, l)]; cbn; rewrite !Z.eqb_refl; cbn; rewrite ?orb_true_r; auto.
Qed.

(** What the witness's checker accepts is true: the claim is false. *)
Theorem check_hit_sound strict s w : check_hit strict s w = true -> ~ never_touch strict s.
Proof.
  unfold check_hit; rewrite !andb_true_iff.
  intros [[[[[[[[[[_ D] T0] T1] N] A] B] X] I] K] E] H.
  apply Z.ltb_lt in D. apply Z.leb_le in T0, T1.
  set (t := IZR (wc w) / IZR (wd w)).
  assert (t * IZR (wd w) = IZR (wc w)) as Et by (unfold t; apply IZR_lt in D; field; lra).
  apply (side_sound _ _ _ t) in A as (Hi & Wp & IP & CP & HP).
  apply (side_sound _ _ _ t) in B as (Hj & Wq & IQ & CQ & HQ).
  set (x := comb _ _) in HP. set (y := comb _ _) in HQ.
  assert (forall n q, square_in s w n = Some q -> proper q /\ ratR q = (dotR n x - dotR n y) ^ 2) as S.
  { intros n r. unfold square_in. destruct (moment _ _ _ _ (wp w)) as [p|] eqn:Mp; [|discriminate].
    destruct (moment _ _ _ _ (wq w)) as [q|] eqn:Mq; [|discriminate]. cbn zeta. intros Q. injection Q as <-.
    apply (moment_sound s n _ _ (IZR (total (wp w)))) in Mp as [Pp Vp]; auto; [|lra].
    apply (moment_sound s n _ _ (IZR (total (wq w)))) in Mq as [Pq Vq]; auto; [|lra].
    unfold x, y. fold t in Vp, Vq. rewrite <- Vp, <- Vq. unfold ratR, proper in *. cbn [fst snd].
    apply lt_IZR in Wp, Wq. split.
    - repeat apply Z.mul_pos_pos; auto.
    - rewrite !mult_IZR, minus_IZR, !mult_IZR. apply IZR_lt in Wp, Wq, Pp, Pq. field. lra. }
  unfold near in E. destruct (square_in s w (V3 1 0 0)) as [q1|] eqn:E1; [|discriminate].
  destruct (square_in s w (V3 0 1 0)) as [q2|] eqn:E2; [|discriminate].
  destruct (square_in s w (V3 0 0 1)) as [q3|] eqn:E3; [|discriminate].
  apply S in E1 as [P1 E1], E2 as [P2 E2], E3 as [P3 E3].
  destruct (rat_add_sound q2 q3) as [P4 E4]; auto. destruct (rat_add_sound q1 (rat_add q2 q3)) as [P5 E5]; auto.
  cbn zeta in E. apply Z.leb_le, IZR_le in E. rewrite !mult_IZR in E. apply IZR_lt in P5.
  assert (ratR (rat_add q1 (rat_add q2 q3)) <= IZR (eta s) ^ 2) as L.
  { unfold ratR. apply (Rmult_le_reg_r (IZR (snd (rat_add q1 (rat_add q2 q3))))); auto.
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  rewrite E5, E4, E1, E2, E3 in L. unfold dotR in L; cbn [vx vy vz] in L.
  apply (Rlt_not_le (dist2 x y) (IZR (eta s) ^ 2)); [|unfold dist2; lra].
  apply IZR_lt in D as D'.
  apply Z.eqb_eq in K.
  refine (proj2 (H t _ (wi w) (wj w) Hi Hj _ _ _ _ IP IQ x y HP HQ) _).
  - apply IZR_le in T0, T1. rewrite mult_IZR in T0, T1. rewrite <- Et in T0, T1.
    split; eapply Rmult_le_reg_r; eauto.
  - apply orb_true_iff in N as [N|N]; [now left|]. right. now apply negb_true_iff, Z.eqb_neq in N.
  - intros Y. apply excluded_pair_complete in Y. rewrite Y in X. discriminate.
  - intros v u V1 V2 W. rewrite K in W. cbn in W. subst u. rewrite map_map in V1, V2. apply in_map_iff in V1 as (a & <- & Ha), V2 as (b & Eb & Hb).
    rewrite forallb_forall in I. apply I in Ha. rewrite forallb_forall in Ha. apply Ha in Hb.
    now rewrite Eb, Z.eqb_refl in Hb.
Qed.

(** A witness of two different cells refutes the strict claim as well. *)
Corollary check_hit_sound_both s w : check_hit false s w = true -> forall strict, ~ never_touch strict s.
Proof.
  intros H [|] N; apply (check_hit_sound false s w H); auto. now apply never_touch_weaken.
Qed.
