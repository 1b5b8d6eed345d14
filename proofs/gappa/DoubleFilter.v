(* SPDX-License-Identifier: Apache-2.0 *)
(** * kernel/double_filter.h: the error bounds of the coplanarity cubic and of the insides

    Notation: that of Rounding.v and Formulas.v.
      [ma]   the largest magnitude of a computed component of the moving vector a, over both ends
             of the step; mb, mc
      [differs m d e]   d is a computed difference of points, e the exact one (Differences.v)

    Each theorem has the bound as the code computes it, rounded.

    Not here: that signs of coefficients decide as kernel/bernstein.h says; overflow (m < 2^300 is tested
    there); insides throughout a sliver (25 u + 9 reach, and the slope of g_on). *)
Require Import Reals Psatz.
From Flocq Require Import Core.
From Gappa Require Import Gappa_tactic.
From NoliGappa Require Import Constants Rounding Formulas Differences Bernstein.
Open Scope R_scope.

(** ** Blocks: what is computed, from what is near 1, 2 or 4 times a scale *)

(** The comment's 8u. *)
Lemma det2_block S T a b c d a' b' c' d' : 0 < S -> 0 < T -> 0 < S * T -> tiny <= S * T ->
  near 1 (1025 * ee) S a a' -> near 1 (1025 * ee) S b b' -> near 1 (1025 * ee) T c c' ->
  near 1 (1025 * ee) T d d' ->
  near (2049 / 1024) (8210 * ee) (S * T) (det2 rnd a b c d) (det2 exact a' b' c' d').
Proof. intros. unfold det2, exact. by_gappa. Qed.

(** The comment's 20u. *)
Lemma sum_block S a b a' b' : 0 < S -> tiny <= S ->
  near (2049 / 1024) (8210 * ee) S a a' -> near (2049 / 1024) (8210 * ee) S b b' ->
  near (4099 / 1024) (20530 * ee) S (rnd (a + b)) (a' + b').
Proof. intros. by_gappa. Qed.

(** The comment's 46u at one end, and the 104u that a middle coefficient has besides. *)
Lemma outer_block S T c0 c1 c2 d0 d1 d2 c0' c1' c2' d0' d1' d2' :
  0 < S -> 0 < T -> 0 < S * T -> tiny <= S * T ->
  near 1 (1025 * ee) S c0 c0' -> near 1 (1025 * ee) S c1 c1' -> near 1 (1025 * ee) S c2 c2' ->
  near (2049 / 1024) (8210 * ee) T d0 d0' -> near (2049 / 1024) (8210 * ee) T d1 d1' ->
  near (2049 / 1024) (8210 * ee) T d2 d2' ->
  near (6149 / 1024) (47300 * ee) (S * T)
    (dot rnd (Vec c0 c1 c2) (Vec d0 d1 d2)) (dot exact (Vec c0' c1' c2') (Vec d0' d1' d2')).
Proof. intros. unfold dot, exact; simpl. by_gappa. Qed.

Lemma middle_block S T c0 c1 c2 d0 d1 d2 c0' c1' c2' d0' d1' d2' :
  0 < S -> 0 < T -> 0 < S * T -> tiny <= S * T ->
  near 1 (1025 * ee) S c0 c0' -> near 1 (1025 * ee) S c1 c1' -> near 1 (1025 * ee) S c2 c2' ->
  near (4099 / 1024) (20530 * ee) T d0 d0' -> near (4099 / 1024) (20530 * ee) T d1 d1' ->
  near (4099 / 1024) (20530 * ee) T d2 d2' ->
  near (12300 / 1024) (107000 * ee) (S * T)
    (dot rnd (Vec c0 c1 c2) (Vec d0 d1 d2)) (dot exact (Vec c0' c1' c2') (Vec d0' d1' d2')).
Proof. intros. unfold dot, exact; simpl. by_gappa. Qed.

Lemma inner_block S a b a' b' : 0 < S -> tiny <= S ->
  near (6149 / 1024) (47300 * ee) S a a' -> near (12300 / 1024) (107000 * ee) S b b' ->
  near (18450 / 1024) (172900 * ee) S (rnd (a + b)) (a' + b').
Proof. intros. by_gappa. Qed.

Lemma triple_block S a a' : 0 < S -> tiny <= S ->
  near (6149 / 1024) (47300 * ee) S a a' -> near (18450 / 1024) (172900 * ee) S (rnd (3 * a)) (3 * a').
Proof. intros. by_gappa. Qed.

Lemma double_block S a a' : 0 < S -> tiny <= S ->
  near (2049 / 1024) (8210 * ee) S a a' -> near (4099 / 1024) (20530 * ee) S (rnd (2 * a)) (2 * a').
Proof. intros. by_gappa. Qed.

(** ** Coefficients of the cubic *)

Lemma product_large ma mb : least_size < ma -> least_size < mb ->
  0 < ma /\ 0 < mb /\ 0 < ma * mb /\ tiny <= ma * mb.
Proof.
  assert (Q : 0 < least_size) by apply bpow_gt_0.
  assert (T : tiny <= least_size * least_size).
  { unfold least_size. rewrite <- bpow_plus. apply bpow_le. lia. }
  intros A B. assert (least_size * least_size <= ma * mb) by (apply Rmult_le_compat; lra).
  pose proof tiny_pos. repeat split; lra.
Qed.

Lemma volume_large ma mb mc : least_size < ma -> least_size < mb -> least_size < mc ->
  0 < mc * (ma * mb) /\ tiny <= mc * (ma * mb).
Proof.
  assert (Q : 0 < least_size) by apply bpow_gt_0.
  assert (T : tiny <= least_size * (least_size * least_size)).
  { unfold least_size. rewrite <- !bpow_plus. apply bpow_le. lia. }
  intros A B C. pose proof tiny_pos.
  assert (least_size * least_size <= ma * mb) by (apply Rmult_le_compat; lra).
  assert (least_size * (least_size * least_size) <= mc * (ma * mb)).
  { apply Rmult_le_compat; try lra. apply Rlt_le, Rmult_lt_0_compat; lra. }
  split; lra.
Qed.

Section Cubic.
Variables ma mb mc : R.
Hypothesis la : least_size < ma.
Hypothesis lb : least_size < mb.
Hypothesis lc : least_size < mc.
Let V := mc * (ma * mb).

Definition near_vec b d S v w :=
  near b d S (x0 v) (x0 w) /\ near b d S (x1 v) (x1 w) /\ near b d S (x2 v) (x2 w).

Lemma cross_near a b a' b' : differs ma a a' -> differs mb b b' ->
  near_vec (2049 / 1024) (8210 * ee) (ma * mb) (cross rnd a b) (cross exact a' b').
Proof.
  intros A B. destruct (product_large ma mb la lb) as (P & Q & R & T).
  destruct (differs_near _ _ _ A) as (A0 & A1 & A2). destruct (differs_near _ _ _ B) as (B0 & B1 & B2).
  split; [ | split]; now apply det2_block.
Qed.

Lemma middle_near a0 a1 b0 b1 a0' a1' b0' b1' :
  differs ma a0 a0' -> differs ma a1 a1' -> differs mb b0 b0' -> differs mb b1 b1' ->
  near_vec (4099 / 1024) (20530 * ee) (ma * mb)
    (plus rnd (cross rnd a0 b1) (cross rnd a1 b0)) (plus exact (cross exact a0' b1') (cross exact a1' b0')).
Proof.
  intros A0 A1 B0 B1. destruct (product_large ma mb la lb) as (P & Q & R & T).
  destruct (cross_near _ _ _ _ A0 B1) as (C0 & C1 & C2).
  destruct (cross_near _ _ _ _ A1 B0) as (D0 & D1 & D2).
  split; [ | split]; now apply sum_block.
Qed.

Lemma dot_cross_near c c' d d' : differs mc c c' -> near_vec (2049 / 1024) (8210 * ee) (ma * mb) d d' ->
  near (6149 / 1024) (47300 * ee) V (dot rnd c d) (dot exact c' d').
Proof.
  intros C (D0 & D1 & D2). destruct (product_large ma mb la lb) as (P & Q & R & T).
  destruct (volume_large ma mb mc la lb lc) as (P' & T'). destruct (differs_near _ _ _ C) as (C0 & C1 & C2).
  assert (0 < mc) by (pose proof (bpow_gt_0 radix2 (-300)); unfold least_size in lc; lra).
  destruct c, c', d, d'. now apply outer_block.
Qed.

Lemma dot_middle_near c c' d d' : differs mc c c' -> near_vec (4099 / 1024) (20530 * ee) (ma * mb) d d' ->
  near (12300 / 1024) (107000 * ee) V (dot rnd c d) (dot exact c' d').
Proof.
  intros C (D0 & D1 & D2). destruct (product_large ma mb la lb) as (P & Q & R & T).
  destruct (volume_large ma mb mc la lb lc) as (P' & T'). destruct (differs_near _ _ _ C) as (C0 & C1 & C2).
  assert (0 < mc) by (pose proof (bpow_gt_0 radix2 (-300)); unfold least_size in lc; lra).
  destruct c, c', d, d'. now apply middle_block.
Qed.

Lemma outer_near a b c a' b' c' : differs ma a a' -> differs mb b b' -> differs mc c c' ->
  near (18450 / 1024) (172900 * ee) V (outer rnd a b c) (outer exact a' b' c').
Proof.
  intros A B C. destruct (volume_large ma mb mc la lb lc) as (P & T).
  unfold outer. apply triple_block; [exact P | exact T | ]. apply dot_cross_near; [exact C | ].
  now apply cross_near.
Qed.

Lemma inner_near a b c c' a0 a1 b0 b1 fa fb fc fc' fa0 fa1 fb0 fb1 :
  differs ma a fa -> differs mb b fb -> differs mc c fc -> differs mc c' fc' ->
  differs ma a0 fa0 -> differs ma a1 fa1 -> differs mb b0 fb0 -> differs mb b1 fb1 ->
  near (18450 / 1024) (172900 * ee) V
    (inner rnd a b c c' a0 a1 b0 b1) (inner exact fa fb fc fc' fa0 fa1 fb0 fb1).
Proof.
  intros. destruct (volume_large ma mb mc la lb lc) as (P & T). unfold inner.
  apply inner_block; [exact P | exact T | | ].
  - apply dot_cross_near; [assumption | ]. now apply cross_near.
  - apply dot_middle_near; [assumption | ]. now apply middle_near.
Qed.

(** volume() * u, with volume() = m[0] * m[1] * m[2] *)
Definition volume_u a b c := rnd (rnd (rnd (a * b) * c) * u).

(** coplanarity_units * v, and that plus coplanarity_level_units * v *)
Definition coplanarity_bound := rnd (coplanarity_units * volume_u ma mb mc).
Definition coplanarity_value_bound :=
  rnd (coplanarity_bound + rnd (coplanarity_level_units * volume_u ma mb mc)).

Lemma coplanarity_bounds :
  175 * uu * V <= coplanarity_bound /\ 342 * uu * V <= coplanarity_value_bound.
Proof.
  destruct (product_large ma mb la lb) as (P & Q & R & T).
  destruct (volume_large ma mb mc la lb lc) as (P' & T').
  unfold coplanarity_value_bound, coplanarity_bound, coplanarity_units, coplanarity_level_units, volume_u.
  rewrite u_is.
  replace (ma * mb) with (ma * mb * 1) by ring. destruct (rnd_scaled (ma * mb) 1 T) as (p & -> & wp & ? & ?).
  replace (ma * mb * p * mc) with (V * p) by (unfold V; ring).
  destruct (rnd_scaled V p T') as (q & -> & wq & ? & ?).
  replace (V * q * uu) with (V * (q * uu)) by ring.
  destruct (rnd_scaled V (q * uu) T') as (v & -> & w & ? & ?).
  rewrite (number_scaled V 176 v), (number_scaled V 168 v).
  destruct (rnd_scaled V (176 * v) T') as (c & -> & wc & ? & ?).
  destruct (rnd_scaled V (168 * v) T') as (l & -> & wl & ? & ?). rewrite sum_scaled.
  destruct (rnd_scaled V (c + l) T') as (b & -> & wb & ? & ?).
  rewrite (Rmult_comm (175 * uu) V), (Rmult_comm (342 * uu) V).
  split; (apply Rmult_le_compat_l; [apply Rlt_le, P' | ]); gappa.
Qed.

(** outer * 3, and inner, are off by less than the bound of a coefficient. *)
Theorem outer_error a b c a' b' c' : differs ma a a' -> differs mb b b' -> differs mc c c' ->
  Rabs (outer rnd a b c - outer exact a' b' c') <= coplanarity_bound.
Proof.
  intros A B C. destruct (outer_near _ _ _ _ _ _ A B C) as [_ E]. destruct coplanarity_bounds as [K _].
  destruct (volume_large ma mb mc la lb lc) as (P & _). fold V in P. lra.
Qed.

Theorem inner_error a b c c' a0 a1 b0 b1 fa fb fc fc' fa0 fa1 fb0 fb1 :
  differs ma a fa -> differs mb b fb -> differs mc c fc -> differs mc c' fc' ->
  differs ma a0 fa0 -> differs ma a1 fa1 -> differs mb b0 fb0 -> differs mb b1 fb1 ->
  Rabs (inner rnd a b c c' a0 a1 b0 b1 - inner exact fa fb fc fc' fa0 fa1 fb0 fb1) <= coplanarity_bound.
Proof.
  intros. pose proof (inner_near a b c c' a0 a1 b0 b1 fa fb fc fc' fa0 fa1 fb0 fb1) as [_ E]; try assumption.
  destruct coplanarity_bounds as [K _]. destruct (volume_large ma mb mc la lb lc) as (P & _). fold V in P.
  lra.
Qed.

(** ** The cubic at a time: three times the determinant there *)

Definition coplanarity_at r a0 a1 b0 b1 c0 c1 t := cubic_value r
  (outer r a0 b0 c0) (inner r a0 b0 c0 c1 a0 a1 b0 b1) (inner r a1 b1 c1 c0 a0 a1 b0 b1) (outer r a1 b1 c1) t.

Lemma coplanarity_exact a0 a1 b0 b1 c0 c1 t :
  coplanarity_at exact a0 a1 b0 b1 c0 c1 t =
  3 * dot exact (at_time t c0 c1) (cross exact (at_time t a0 a1) (at_time t b0 b1)).
Proof.
  unfold coplanarity_at, cubic_value, lerp, outer, inner, dot, cross, plus, det2, at_time, exact; simpl. ring.
Qed.

(** On the whole step; a part of it has other coefficients (Bernstein.v). *)
Theorem coplanarity_value_error a0 a1 b0 b1 c0 c1 a0' a1' b0' b1' c0' c1' t :
  differs ma a0 a0' -> differs ma a1 a1' -> differs mb b0 b0' -> differs mb b1 b1' ->
  differs mc c0 c0' -> differs mc c1 c1' -> F64 t -> 0 <= t <= 1 ->
  Rabs (coplanarity_at rnd a0 a1 b0 b1 c0 c1 t -
        3 * dot exact (at_time t c0' c1') (cross exact (at_time t a0' a1') (at_time t b0' b1')))
    <= coplanarity_value_bound.
Proof.
  intros A0 A1 B0 B1 C0 C1 F Ht. rewrite <- coplanarity_exact. unfold coplanarity_at.
  destruct (volume_large ma mb mc la lb lc) as (P & T). fold V in P, T.
  eapply Rle_trans.
  - apply near_cubic with (b := 18450 / 1024) (d := 172900 * ee) (S := V); try assumption; try lra;
      first [now apply outer_near | now apply inner_near].
  - destruct coplanarity_bounds as [_ K]. lra.
Qed.

End Cubic.

(** ** Insides: a component of a x b, or the difference c - w of two of them

    area[0] = m[0] * m[1] * u *)
Definition area_u ma mb := rnd (rnd (ma * mb) * u).
Definition inside_bound ma mb := rnd (inside_units * area_u ma mb).
(** inside_difference_units * (uv + wu) *)
Definition inside_difference_bound ma mb mc md :=
  rnd (inside_difference_units * rnd (area_u ma mb + area_u mc md)).

Lemma area_scaled ma mb : least_size < ma -> least_size < mb ->
  exists v, area_u ma mb = ma * mb * v /\ 1023 * ee <= v <= 1025 * ee.
Proof.
  intros la lb. destruct (product_large ma mb la lb) as (P & Q & R & T). unfold area_u. rewrite u_is.
  destruct (rnd_scaled (ma * mb) 1 T) as (p & E & wp & ? & ?). rewrite Rmult_1_r in E. rewrite E.
  replace (ma * mb * p * uu) with (ma * mb * (p * uu)) by ring.
  destruct (rnd_scaled (ma * mb) (p * uu) T) as (v & -> & w & ? & ?).
  exists v. split; [reflexivity | gappa].
Qed.

Lemma inside_bound_lower ma mb : least_size < ma -> least_size < mb ->
  20900 * ee * (ma * mb) <= inside_bound ma mb.
Proof.
  intros la lb. destruct (product_large ma mb la lb) as (P & Q & R & T).
  destruct (area_scaled ma mb la lb) as (v & E & ?). unfold inside_bound, inside_units.
  rewrite E, (number_scaled (ma * mb) 21 v).
  destruct (rnd_scaled (ma * mb) (21 * v) T) as (b & -> & w & ? & ?).
  rewrite (Rmult_comm _ (ma * mb)). apply Rmult_le_compat_l; [lra | gappa].
Qed.

Lemma inside_difference_bound_lower ma mb mc md :
  least_size < ma -> least_size < mb -> least_size < mc -> least_size < md ->
  25400 * ee * (ma * mb + mc * md) <= inside_difference_bound ma mb mc md.
Proof.
  intros la lb lc ld. destruct (product_large ma mb la lb) as (_ & _ & R & T).
  destruct (product_large mc md lc ld) as (_ & _ & R' & T').
  destruct (area_scaled ma mb la lb) as (v & E & V). destruct (area_scaled mc md lc ld) as (w & F & W).
  unfold inside_difference_bound, inside_difference_units. rewrite E, F.
  assert (0 <= ma * mb * (v - 1023 * ee)) by (apply Rmult_le_pos; lra).
  assert (0 <= mc * md * (w - 1023 * ee)) by (apply Rmult_le_pos; lra).
  assert (A : 1023 * ee * (ma * mb + mc * md) <= ma * mb * v + mc * md * w) by lra.
  assert (P : 0 <= ma * mb * v + mc * md * w) by lra.
  pose proof (rnd_lower _ P) as B. pose proof tiny_pos.
  assert (P' : 0 <= 25 * rnd (ma * mb * v + mc * md * w)) by (pose proof (rnd_pos _ P); lra).
  pose proof (rnd_lower _ P'). lra.
Qed.

(** The coefficients at an end and in the middle: form.front() * 2, and c[1].  The hypotheses [near] are what
    [differs_near] says of the components of computed differences. *)
Theorem inside_end_error ma mb p q s t p' q' s' t' : least_size < ma -> least_size < mb ->
  near 1 (1025 * ee) ma p p' -> near 1 (1025 * ee) ma q q' ->
  near 1 (1025 * ee) mb s s' -> near 1 (1025 * ee) mb t t' ->
  Rabs (rnd (2 * det2 rnd p q s t) - 2 * det2 exact p' q' s' t') <= inside_bound ma mb.
Proof.
  intros la lb. intros. destruct (product_large ma mb la lb) as (P & Q & R & T).
  pose proof (inside_bound_lower ma mb la lb).
  assert (N : near (4099 / 1024) (20530 * ee) (ma * mb)
    (rnd (2 * det2 rnd p q s t)) (2 * det2 exact p' q' s' t')).
  { apply double_block; try assumption. now apply det2_block. }
  destruct N as [_ N]. lra.
Qed.

Lemma inside_middle_near ma mb p0 q0 p1 q1 s0 t0 s1 t1 p0' q0' p1' q1' s0' t0' s1' t1' :
  least_size < ma -> least_size < mb ->
  near 1 (1025 * ee) ma p0 p0' -> near 1 (1025 * ee) ma q0 q0' ->
  near 1 (1025 * ee) ma p1 p1' -> near 1 (1025 * ee) ma q1 q1' ->
  near 1 (1025 * ee) mb s0 s0' -> near 1 (1025 * ee) mb t0 t0' ->
  near 1 (1025 * ee) mb s1 s1' -> near 1 (1025 * ee) mb t1 t1' ->
  near (4099 / 1024) (20530 * ee) (ma * mb)
    (det2_middle rnd p0 q0 p1 q1 s0 t0 s1 t1) (det2_middle exact p0' q0' p1' q1' s0' t0' s1' t1').
Proof.
  intros la lb. intros. destruct (product_large ma mb la lb) as (P & Q & R & T).
  unfold det2_middle. apply sum_block; try assumption; now apply det2_block.
Qed.

Theorem inside_middle_error ma mb p0 q0 p1 q1 s0 t0 s1 t1 p0' q0' p1' q1' s0' t0' s1' t1' :
  least_size < ma -> least_size < mb ->
  near 1 (1025 * ee) ma p0 p0' -> near 1 (1025 * ee) ma q0 q0' ->
  near 1 (1025 * ee) ma p1 p1' -> near 1 (1025 * ee) ma q1 q1' ->
  near 1 (1025 * ee) mb s0 s0' -> near 1 (1025 * ee) mb t0 t0' ->
  near 1 (1025 * ee) mb s1 s1' -> near 1 (1025 * ee) mb t1 t1' ->
  Rabs (det2_middle rnd p0 q0 p1 q1 s0 t0 s1 t1 - det2_middle exact p0' q0' p1' q1' s0' t0' s1' t1')
    <= inside_bound ma mb.
Proof.
  intros la lb. intros. pose proof (inside_bound_lower ma mb la lb).
  destruct (product_large ma mb la lb) as (P & Q & R & T).
  pose proof (inside_middle_near ma mb p0 q0 p1 q1 s0 t0 s1 t1 p0' q0' p1' q1' s0' t0' s1' t1' la lb)
    as [_ N]; try assumption. lra.
Qed.

(** c - w: at an end, before it is doubled, and in the middle.  [c] and [w] are what [det2] or
    [det2_middle] gives: for the ends within 8210 ee ([det2_block]), for the middle within
    20530 ee ([inside_middle_near]). *)
Section Difference.
Variables ma mb mc md : R.
Hypothesis la : least_size < ma.
Hypothesis lb : least_size < mb.
Hypothesis lc : least_size < mc.
Hypothesis ld : least_size < md.
Let S := ma * mb + mc * md.

Lemma sum_large : tiny <= S /\ 0 < S.
Proof.
  destruct (product_large ma mb la lb) as (_ & _ & R & T).
  destruct (product_large mc md lc ld) as (_ & _ & R' & T').
  unfold S. split; lra.
Qed.

Lemma inside_difference_end_near c w c' w' :
  near (2049 / 1024) (8210 * ee) (ma * mb) c c' -> near (2049 / 1024) (8210 * ee) (mc * md) w w' ->
  near (4 + 1/8) (24800 * ee) S (rnd (2 * rnd (c - w))) (2 * (c' - w')).
Proof.
  intros C W. destruct sum_large as [T P]. pose proof tiny_pos.
  pose proof (near_plus _ _ _ _ _ _ _ _ C (near_opp _ _ _ _ _ W)) as N.
  fold (c - w) in N. fold (c' - w') in N. fold S in N.
  apply near_rnd in N; [ | exact T]. destruct N as [A B].
  apply near_rnd' with (b := 4 + 1/16) (d := 20600 * ee); [exact T | | lra | lra].
  apply Rabs_le_inv in A. apply Rabs_le_inv in B. split; apply Rabs_le; lra.
Qed.

Lemma inside_difference_middle_near c w c' w' :
  near (4099 / 1024) (20530 * ee) (ma * mb) c c' -> near (4099 / 1024) (20530 * ee) (mc * md) w w' ->
  near (4 + 1/8) (24800 * ee) S (rnd (c - w)) (c' - w').
Proof.
  intros C W. destruct sum_large as [T P].
  pose proof (near_plus _ _ _ _ _ _ _ _ C (near_opp _ _ _ _ _ W)) as N.
  fold (c - w) in N. fold (c' - w') in N. fold S in N.
  apply near_rnd' with (b := 4099 / 1024) (d := 20530 * ee); [exact T | exact N | lra | lra].
Qed.

Lemma inside_difference_error v x :
  near (4 + 1/8) (24800 * ee) S v x -> Rabs (v - x) <= inside_difference_bound ma mb mc md.
Proof.
  intros [_ N]. destruct sum_large as [_ P].
  pose proof (inside_difference_bound_lower ma mb mc md la lb lc ld) as L. fold S in L. lra.
Qed.

Theorem inside_difference_end_error c w c' w' :
  near (2049 / 1024) (8210 * ee) (ma * mb) c c' -> near (2049 / 1024) (8210 * ee) (mc * md) w w' ->
  Rabs (rnd (2 * rnd (c - w)) - 2 * (c' - w')) <= inside_difference_bound ma mb mc md.
Proof. intros C W. now apply inside_difference_error, inside_difference_end_near. Qed.

Theorem inside_difference_middle_error c w c' w' :
  near (4099 / 1024) (20530 * ee) (ma * mb) c c' -> near (4099 / 1024) (20530 * ee) (mc * md) w w' ->
  Rabs (rnd (c - w) - (c' - w')) <= inside_difference_bound ma mb mc md.
Proof. intros C W. now apply inside_difference_error, inside_difference_middle_near. Qed.

End Difference.

(** ** An inside at a time, by de Casteljau: g_bound + g_level *)
Definition inside_value_bound ma mb := rnd (inside_bound ma mb + rnd (inside_level_units * area_u ma mb)).
Definition inside_difference_value_bound ma mb mc md :=
  rnd (inside_difference_bound ma mb mc md + rnd (inside_level_units * rnd (area_u ma mb + area_u mc md))).

(** c0, c1, c2: the coefficients of [inside_end_error] and [inside_middle_error]. *)
Theorem inside_value_error ma mb c0 c1 c2 e0 e1 e2 t :
  least_size < ma -> least_size < mb -> F64 t -> 0 <= t <= 1 ->
  near (4099 / 1024) (20530 * ee) (ma * mb) c0 e0 -> near (4099 / 1024) (20530 * ee) (ma * mb) c1 e1 ->
  near (4099 / 1024) (20530 * ee) (ma * mb) c2 e2 ->
  Rabs (quadratic_value rnd c0 c1 c2 t - quadratic_value exact e0 e1 e2 t) <= inside_value_bound ma mb.
Proof.
  intros la lb F Ht A B C. destruct (product_large ma mb la lb) as (_ & _ & R & T). pose proof tiny_pos.
  assert (K : 1 <= 4099 / 1024 <= 31) by lra.
  apply Rle_trans with (1 := near_quadratic _ _ _ _ _ _ _ _ _ _ K T F Ht A B C).
  pose proof (inside_bound_lower ma mb la lb) as L. destruct (area_scaled ma mb la lb) as (v & E & V).
  assert (0 <= ma * mb * (v - 1023 * ee)) by (apply Rmult_le_pos; lra).
  assert (G : 1023 * ee * (ma * mb) <= area_u ma mb) by (rewrite E; lra).
  unfold inside_value_bound, inside_level_units.
  assert (P : 0 <= 25 * area_u ma mb) by lra. pose proof (rnd_lower _ P). pose proof (rnd_pos _ P).
  set (l := rnd (25 * area_u ma mb)) in *.
  assert (Q : 0 <= inside_bound ma mb + l) by lra. pose proof (rnd_lower _ Q). lra.
Qed.

(** c0, c1, c2: as in [inside_difference_end_near] and [inside_difference_middle_near]. *)
Theorem inside_difference_value_error ma mb mc md c0 c1 c2 e0 e1 e2 t :
  least_size < ma -> least_size < mb -> least_size < mc -> least_size < md -> F64 t -> 0 <= t <= 1 ->
  let S := ma * mb + mc * md in
  near (4 + 1/8) (24800 * ee) S c0 e0 -> near (4 + 1/8) (24800 * ee) S c1 e1 ->
  near (4 + 1/8) (24800 * ee) S c2 e2 ->
  Rabs (quadratic_value rnd c0 c1 c2 t - quadratic_value exact e0 e1 e2 t)
    <= inside_difference_value_bound ma mb mc md.
Proof.
  cbv zeta. intros la lb lc ld F Ht A B C. destruct (product_large ma mb la lb) as (_ & _ & R & T).
  destruct (product_large mc md lc ld) as (_ & _ & R' & T'). pose proof tiny_pos.
  pose proof (inside_difference_bound_lower ma mb mc md la lb lc ld) as L.
  destruct (area_scaled ma mb la lb) as (v & E & V). destruct (area_scaled mc md lc ld) as (w & E' & V').
  assert (0 <= ma * mb * (v - 1023 * ee)) by (apply Rmult_le_pos; lra).
  assert (0 <= mc * md * (w - 1023 * ee)) by (apply Rmult_le_pos; lra).
  assert (G : 1023 * ee * (ma * mb + mc * md) <= area_u ma mb + area_u mc md) by (rewrite E, E'; lra).
  set (S := ma * mb + mc * md) in *. assert (K : 1 <= 4 + 1/8 <= 31) by lra.
  assert (TS : tiny <= S) by (unfold S; lra).
  apply Rle_trans with (1 := near_quadratic _ _ _ _ _ _ _ _ _ _ K TS F Ht A B C).
  unfold inside_difference_value_bound, inside_level_units.
  assert (O : 0 <= area_u ma mb + area_u mc md) by lra. pose proof (rnd_lower _ O). pose proof (rnd_pos _ O).
  set (a := rnd (area_u ma mb + area_u mc md)) in *.
  assert (P : 0 <= 25 * a) by lra. pose proof (rnd_lower _ P). pose proof (rnd_pos _ P).
  set (l := rnd (25 * a)) in *.
  assert (Q : 0 <= inside_difference_bound ma mb mc md + l) by lra. pose proof (rnd_lower _ Q). lra.
Qed.
