(* SPDX-License-Identifier: Apache-2.0 *)
(** * kernel/direction_filter.h: [separate] is right when it says that a direction separates

    Notation: that of Rounding.v and Formulas.v.
      [n]   the direction, of any doubles;  N  the largest of |n[k]|
      [m]   the largest magnitude of a computed difference of coordinates

    Not here: that the direction is a good one; overflow (m < 2^300 is tested there). *)
Require Import Reals Psatz.
From Flocq Require Import Core.
From Gappa Require Import Gappa_tactic.
From NoliGappa Require Import Constants Rounding Formulas Differences.
Open Scope R_scope.

(** bound = units * u * n * m *)
Definition bound units N m := rnd (rnd (rnd (units * u) * N) * m).

Lemma scale_large N m : least_normal < N -> least_size < m -> 0 < N /\ 0 < m /\ tiny <= N * m /\ tiny <= N.
Proof.
  assert (P : 0 < least_normal) by apply bpow_gt_0. assert (Q : 0 < least_size) by apply bpow_gt_0.
  assert (S : tiny <= least_normal) by (apply bpow_le; lia).
  assert (T : tiny <= least_normal * least_size).
  { unfold least_normal, least_size. rewrite <- bpow_plus. apply bpow_le. lia. }
  intros A B. repeat split; [lra | lra | | lra].
  apply Rle_trans with (1 := T). apply Rmult_le_compat; lra.
Qed.

Lemma vertex_face_bound N m : least_normal < N -> least_size < m ->
  15 * uu * (N * m) <= bound vertex_face_units N m.
Proof.
  intros A B. destruct (scale_large N m A B) as (P & Q & T & T').
  unfold bound, vertex_face_units. rewrite u_is. set (c := rnd (16 * uu)).
  rewrite (Rmult_comm c). destruct (rnd_scaled N c T') as (v & -> & w & ? & ?).
  replace (N * v * m) with (N * m * v) by ring.
  destruct (rnd_scaled (N * m) v T) as (v' & -> & w' & ? & ?).
  rewrite (Rmult_comm (15 * uu)). apply Rmult_le_compat_l; [apply Rlt_le, Rmult_lt_0_compat; assumption | ].
  unfold c, rnd in *. gappa.
Qed.

Lemma edge_edge_bound N m : least_normal < N -> least_size < m ->
  59 * uu * (N * m) <= bound edge_edge_units N m.
Proof.
  intros A B. destruct (scale_large N m A B) as (P & Q & T & T').
  unfold bound, edge_edge_units. rewrite u_is. set (c := rnd (60 * uu)).
  rewrite (Rmult_comm c). destruct (rnd_scaled N c T') as (v & -> & w & ? & ?).
  replace (N * v * m) with (N * m * v) by ring.
  destruct (rnd_scaled (N * m) v T) as (v' & -> & w' & ? & ?).
  rewrite (Rmult_comm (59 * uu)). apply Rmult_le_compat_l; [apply Rlt_le, Rmult_lt_0_compat; assumption | ].
  unfold c, rnd in *. gappa.
Qed.

(** The comment's "n . d is off by at most 11u |n| m": 12u with all orders. *)
Lemma dot_block N m n0 n1 n2 d0 d1 d2 e0 e1 e2 :
  0 < N -> 0 < m -> tiny <= N * m -> within N n0 -> within N n1 -> within N n2 ->
  near 1 (1025 * ee) m d0 e0 -> near 1 (1025 * ee) m d1 e1 -> near 1 (1025 * ee) m d2 e2 ->
  near (3073 / 1024) (12 * uu) (N * m)
    (dot rnd (Vec n0 n1 n2) (Vec d0 d1 d2)) (dot exact (Vec n0 n1 n2) (Vec e0 e1 e2)).
Proof.
  intros P Q T A0 A1 A2 B0 B1 B2. unfold dot, exact; simpl.
  assert (0 < N * m) by (apply Rmult_lt_0_compat; assumption). by_gappa.
Qed.

Lemma dot_error N m n d e : 0 < N -> 0 < m -> tiny <= N * m -> each (within N) n ->
  near 1 (1025 * ee) m (x0 d) (x0 e) -> near 1 (1025 * ee) m (x1 d) (x1 e) ->
  near 1 (1025 * ee) m (x2 d) (x2 e) ->
  near (3073 / 1024) (12 * uu) (N * m) (dot rnd n d) (dot exact n e).
Proof.
  destruct n, d, e. intros P Q T (A0 & A1 & A2) B0 B1 B2. now apply dot_block.
Qed.

Lemma dot_minus N m n a b : least_normal < N -> least_size < m -> each (within N) n ->
  F64s a -> F64s b -> each (within m) (minus rnd a b) ->
  near (3073 / 1024) (12 * uu) (N * m) (dot rnd n (minus rnd a b)) (dot exact n (minus exact a b)).
Proof.
  intros HN Hm Hn Ha Hb Hd. destruct (scale_large N m HN Hm) as (P & Q & T & _).
  destruct (minus_error m a b Ha Hb Hd) as (E0 & E1 & E2). now apply dot_error.
Qed.

(** ** The face's normal: d = f_i - v, computed, for a corner of the face and the vertex, at one end
    of the step.  Separated at both ends means separated in between: what n . d is there is linear. *)
Theorem vertex_face N m n f v :
  least_normal < N -> least_size < m -> each (within N) n ->
  F64s f -> F64s v -> each (within m) (minus rnd f v) ->
  (bound vertex_face_units N m < dot rnd n (minus rnd f v) -> 0 < dot exact n (minus exact f v)) /\
  (dot rnd n (minus rnd f v) < - bound vertex_face_units N m -> dot exact n (minus exact f v) < 0).
Proof.
  intros HN Hm Hn Hf Hv Hd.
  pose proof (dot_minus N m n f v HN Hm Hn Hf Hv Hd) as [_ A]. apply Rabs_le_inv in A.
  pose proof (vertex_face_bound N m HN Hm) as B. destruct (scale_large N m HN Hm) as (P & Q & T & _).
  pose proof (Rmult_lt_0_compat N m P Q). lra.
Qed.

(** ** The common normal of two edges

    low = (nw - max(nu, 0)) + min(nv, 0),  high = (nw - min(nu, 0)) + max(nv, 0) *)
Definition low (r : R -> R) nu nv nw := r (r (nw - Rmax nu 0) + Rmin nv 0).
Definition high (r : R -> R) nu nv nw := r (r (nw - Rmin nu 0) + Rmax nv 0).

Lemma max_lipschitz a b d : Rabs (a - b) <= d -> Rabs (Rmax a 0 - Rmax b 0) <= d.
Proof. unfold Rmax. intros H. apply Rabs_le_inv in H. apply Rabs_le. repeat destruct Rle_dec; lra. Qed.

Lemma min_lipschitz a b d : Rabs (a - b) <= d -> Rabs (Rmin a 0 - Rmin b 0) <= d.
Proof. unfold Rmin. intros H. apply Rabs_le_inv in H. apply Rabs_le. repeat destruct Rle_dec; lra. Qed.

Lemma near_max b d S v x : 0 <= b * S -> near b d S v x -> near b d S (Rmax v 0) (Rmax x 0).
Proof.
  intros P [A B]. split; [ | now apply max_lipschitz].
  apply Rabs_le_inv in A. apply Rabs_le. unfold Rmax. destruct Rle_dec; lra.
Qed.

Lemma near_min b d S v x : 0 <= b * S -> near b d S v x -> near b d S (Rmin v 0) (Rmin x 0).
Proof.
  intros P [A B]. split; [ | now apply min_lipschitz].
  apply Rabs_le_inv in A. apply Rabs_le. unfold Rmin. destruct Rle_dec; lra.
Qed.

(** The comment's 48u. *)
Lemma three_block S a b c a' b' c' : 0 < S -> tiny <= S ->
  near (3073 / 1024) (12 * uu) S a a' -> near (3073 / 1024) (12 * uu) S b b' ->
  near (3073 / 1024) (12 * uu) S c c' ->
  near (9222 / 1024) (52 * uu) S (rnd (rnd (a - b) + c)) (a' - b' + c').
Proof. intros P T A B C. by_gappa. Qed.

(** a0, a1 and b0, b1 are the edges' ends at one end of the step; u = a1 - a0, v = b1 - b0, w = b0 - a0.
    When low is above the bound, n separates: both points of the one are on the same side of both of the
    other. *)
Theorem edge_edge N m n a0 a1 b0 b1 :
  least_normal < N -> least_size < m -> each (within N) n ->
  F64s a0 -> F64s a1 -> F64s b0 -> F64s b1 ->
  each (within m) (minus rnd a1 a0) -> each (within m) (minus rnd b1 b0) ->
  each (within m) (minus rnd b0 a0) ->
  let nu := dot rnd n (minus rnd a1 a0) in
  let nv := dot rnd n (minus rnd b1 b0) in
  let nw := dot rnd n (minus rnd b0 a0) in
  (bound edge_edge_units N m < low rnd nu nv nw ->
     0 < dot exact n (minus exact b0 a0) /\ 0 < dot exact n (minus exact b0 a1) /\
     0 < dot exact n (minus exact b1 a0) /\ 0 < dot exact n (minus exact b1 a1)) /\
  (high rnd nu nv nw < - bound edge_edge_units N m ->
     dot exact n (minus exact b0 a0) < 0 /\ dot exact n (minus exact b0 a1) < 0 /\
     dot exact n (minus exact b1 a0) < 0 /\ dot exact n (minus exact b1 a1) < 0).
Proof.
  intros HN Hm Hn Ha0 Ha1 Hb0 Hb1 Hu Hv Hw. cbv zeta.
  pose proof (dot_minus N m n a1 a0 HN Hm Hn Ha1 Ha0 Hu) as U.
  pose proof (dot_minus N m n b1 b0 HN Hm Hn Hb1 Hb0 Hv) as V.
  pose proof (dot_minus N m n b0 a0 HN Hm Hn Hb0 Ha0 Hw) as W.
  pose proof (edge_edge_bound N m HN Hm) as B. destruct (scale_large N m HN Hm) as (P & Q & T & _).
  assert (PQ : 0 < N * m) by (apply Rmult_lt_0_compat; assumption).
  assert (PB : 0 <= 3073 / 1024 * (N * m)) by lra.
  set (u' := dot exact n (minus exact a1 a0)) in *. set (v' := dot exact n (minus exact b1 b0)) in *.
  assert (E1 : dot exact n (minus exact b0 a1) = dot exact n (minus exact b0 a0) - u').
  { unfold u', dot, minus, exact; simpl. ring. }
  assert (E2 : dot exact n (minus exact b1 a0) = dot exact n (minus exact b0 a0) + v').
  { unfold v', dot, minus, exact; simpl. ring. }
  assert (E3 : dot exact n (minus exact b1 a1) = dot exact n (minus exact b0 a0) - u' + v').
  { unfold u', v', dot, minus, exact; simpl. ring. }
  set (w' := dot exact n (minus exact b0 a0)) in *. rewrite E1, E2, E3.
  unfold low, high. split; intros H.
  - pose proof (three_block _ _ _ _ _ _ _ PQ T W (near_max _ _ _ _ _ PB U) (near_min _ _ _ _ _ PB V))
      as [_ A].
    apply Rabs_le_inv in A.
    pose proof (Rmax_l u' 0). pose proof (Rmax_r u' 0). pose proof (Rmin_l v' 0). pose proof (Rmin_r v' 0).
    repeat split; lra.
  - pose proof (three_block _ _ _ _ _ _ _ PQ T W (near_min _ _ _ _ _ PB U) (near_max _ _ _ _ _ PB V))
      as [_ A].
    apply Rabs_le_inv in A.
    pose proof (Rmin_l u' 0). pose proof (Rmin_r u' 0). pose proof (Rmax_l v' 0). pose proof (Rmax_r v' 0).
    repeat split; lra.
Qed.
