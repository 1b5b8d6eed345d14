(* SPDX-License-Identifier: Apache-2.0 *)
(** * kernel/bernstein.h: what de Casteljau's algorithm adds to the errors of coefficients

    Notation: that of Rounding.v and Formulas.v.
      [C]   at least the largest magnitude of the computed coefficients;  [D] of their errors

    A level adds at most 3u C (3.01u with all orders), a value of a cubic so 9.1u C, one of a
    quadratic form 6.1u C.
    [lerp] with y = 1 - x exactly is also what split_at does, as its x are multiples of 1/64.

    Not here: that a root is where the search proposes it; its signs are what counts. *)
Require Import Reals Psatz.
From Flocq Require Import Core.
From NoliGappa Require Import Rounding Formulas.
Open Scope R_scope.

(** y stands for 1 - x. *)
Definition complement y x := 0 <= x <= 1 /\ Rabs (y - (1 - x)) <= uu * (1 - x).

Lemma complement_rnd x : F64 x -> 0 <= x <= 1 -> complement (rnd (1 - x)) x.
Proof.
  intros F H. split; [exact H | ].
  pose proof (rnd_minus 1 x F64_1 F) as E. rewrite (Rabs_pos_eq (1 - x)) in E by lra. exact E.
Qed.

Lemma near_lerp b d S c0 c1 e0 e1 y x : tiny <= S -> complement y x ->
  near b d S c0 e0 -> near b d S c1 e1 -> 1 <= b <= 32 ->
  near (b * (1 + 4 * uu)) (d + b * (3082 * ee)) S (lerp rnd c0 c1 y x) (lerp exact e0 e1 (1 - x) x).
Proof.
  intros T [Hx Hy] [A0 B0] [A1 B1] Hb. unfold lerp, exact.
  pose proof tiny_pos as P. assert (Q : 0 < S) by lra.
  set (C := b * S) in *. assert (HC : S <= C) by (unfold C; nra).
  assert (Y : 0 <= y <= (1 - x) * (1 + uu)) by (apply Rabs_le_inv in Hy; lra).
  (* the terms, before anything is rounded *)
  assert (T0 : Rabs (c0 * y) <= C * ((1 - x) * (1 + uu))).
  { rewrite Rabs_mult, (Rabs_pos_eq y) by lra. apply Rmult_le_compat; try lra; apply Rabs_pos. }
  assert (T1 : Rabs (c1 * x) <= C * x).
  { rewrite Rabs_mult, (Rabs_pos_eq x) by lra. apply Rmult_le_compat_r; lra. }
  assert (U0 : Rabs (c0 * y - c0 * (1 - x)) <= C * (uu * (1 - x))).
  { replace (c0 * y - c0 * (1 - x)) with (c0 * (y - (1 - x))) by ring. rewrite Rabs_mult.
    apply Rmult_le_compat; try lra; apply Rabs_pos. }
  pose proof (rnd_error (c0 * y)) as R0. pose proof (rnd_error (c1 * x)) as R1.
  set (p0 := rnd (c0 * y)) in *. set (p1 := rnd (c1 * x)) in *.
  pose proof (rnd_error (p0 + p1)) as R2. set (v := rnd (p0 + p1)) in *.
  (* by how much p0 + p1 is off the computed coefficients' combination *)
  assert (W : Rabs (p0 + p1 - (c0 * (1 - x) + c1 * x)) <= 2050 * ee * C).
  { replace (p0 + p1 - (c0 * (1 - x) + c1 * x))
      with ((p0 - c0 * y) + (p1 - c1 * x) + (c0 * y - c0 * (1 - x))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _).
    pose proof (Rabs_triang (p0 - c0 * y) (p1 - c1 * x)).
    assert (0 <= C * x <= C) by nra. assert (C * (1 - x) = C - C * x) by ring. lra. }
  assert (V : Rabs (c0 * (1 - x) + c1 * x) <= C).
  { apply Rabs_le_inv in A0. apply Rabs_le_inv in A1. apply Rabs_le. nra. }
  assert (E : Rabs ((c0 - e0) * (1 - x) + (c1 - e1) * x) <= d * S).
  { apply Rabs_le_inv in B0. apply Rabs_le_inv in B1. apply Rabs_le. nra. }
  apply Rabs_le_inv in W. apply Rabs_le_inv in V. apply Rabs_le_inv in E.
  assert (M : Rabs (p0 + p1) <= C * (1 + 2050 * ee)) by (apply Rabs_le; lra).
  assert (R3 : Rabs (v - (p0 + p1)) <= 1026 * ee * C) by lra.
  apply Rabs_le_inv in R3.
  unfold near.
  replace (b * (1 + 4 * uu) * S) with (C * (1 + 4 * uu)) by (unfold C; ring).
  replace ((d + b * (3082 * ee)) * S) with (d * S + C * (3082 * ee)) by (unfold C; ring).
  split; apply Rabs_le; lra.
Qed.

Lemma near_quadratic b d S c0 c1 c2 e0 e1 e2 x : 1 <= b <= 31 -> tiny <= S -> F64 x -> 0 <= x <= 1 ->
  near b d S c0 e0 -> near b d S c1 e1 -> near b d S c2 e2 ->
  Rabs (quadratic_value rnd c0 c1 c2 x - quadratic_value exact e0 e1 e2 x) <= (d + b * (6200 * ee)) * S.
Proof.
  intros Hb T F Hx A0 A1 A2. pose proof (complement_rnd x F Hx) as K. unfold quadratic_value.
  change (exact (1 - x)) with (1 - x). set (y := rnd (1 - x)) in *. cbv zeta.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K A0 A1 ltac:(lra)) as P0.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K A1 A2 ltac:(lra)) as P1.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K P0 P1 ltac:(lra)) as [_ Q].
  apply Rle_trans with (1 := Q). pose proof tiny_pos. apply Rmult_le_compat_r; lra.
Qed.

Lemma near_cubic b d S c0 c1 c2 c3 e0 e1 e2 e3 x : 1 <= b <= 31 -> tiny <= S -> F64 x -> 0 <= x <= 1 ->
  near b d S c0 e0 -> near b d S c1 e1 -> near b d S c2 e2 -> near b d S c3 e3 ->
  Rabs (cubic_value rnd c0 c1 c2 c3 x - cubic_value exact e0 e1 e2 e3 x) <= (d + b * (9300 * ee)) * S.
Proof.
  intros Hb T F Hx A0 A1 A2 A3. pose proof (complement_rnd x F Hx) as K. unfold cubic_value.
  change (exact (1 - x)) with (1 - x). set (y := rnd (1 - x)) in *. cbv zeta.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K A0 A1 ltac:(lra)) as P0.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K A1 A2 ltac:(lra)) as P1.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K A2 A3 ltac:(lra)) as P2.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K P0 P1 ltac:(lra)) as Q0.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K P1 P2 ltac:(lra)) as Q1.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K Q0 Q1 ltac:(lra)) as [_ Q].
  apply Rle_trans with (1 := Q). pose proof tiny_pos. apply Rmult_le_compat_r; lra.
Qed.
