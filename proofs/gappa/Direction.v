(* SPDX-License-Identifier: Apache-2.0 *)
(** * proofs/prover/cells/direction.h (and around.h, direction_search.h): what is said to separate
    does

    Notation: that of Rounding.v and Formulas.v.
      [n]      the direction;  [size1 n] = |n|_1
      [r]      the origin of the pair, r0 at the begin and r1 at the end of the step; a, b likewise
      [reach]  at least the largest magnitude of a computed difference of a corner and r
      [s]      a time within the step;  [q]  the projection that the code computes for it
      [R]      |n|_1 reach

    There is no condition on sizes: that underflow is covered is what [error_least] is for.

    Not here: overflow, where the code's comparison fails; raised reaches (proofs/prover/windows/window_cell.h). *)
Require Import Reals Psatz.
From Flocq Require Import Core Mult_error.
From NoliGappa Require Import Constants Rounding Formulas Differences Bernstein.
Open Scope R_scope.

Definition size1 n := Rabs (x0 n) + Rabs (x1 n) + Rabs (x2 n).

(** size = |n[0]| + |n[1]| + |n[2]|;  error_share * (4 * size * reach) + error_least *)
Definition error_bound n reach :=
  let size := rnd (rnd (Rabs (x0 n) + Rabs (x1 n)) + Rabs (x2 n)) in
  rnd (rnd (error_share * rnd (rnd (4 * size) * reach)) + error_least).

(** (1 - s) * step.q[0] + s * step.q[1], where step.q is n . (x - r) *)
Definition q n y0 y1 r0 r1 s :=
  lerp rnd (dot rnd n (minus rnd y0 r0)) (dot rnd n (minus rnd y1 r1)) (rnd (1 - s)) s.

(** Where the interval is the whole step, the code has step.q itself: no other number. *)
Lemma q_at_begin p0 p1 : F64 p0 -> lerp rnd p0 p1 (rnd (1 - 0)) 0 = p0.
Proof.
  intros F. unfold lerp. rewrite Rminus_0_r, Rmult_0_r, rnd_0, Rplus_0_r.
  rewrite (rnd_F64 1), Rmult_1_r, (rnd_F64 p0), (rnd_F64 p0); auto. apply F64_1.
Qed.

Lemma q_at_end p0 p1 : F64 p1 -> lerp rnd p0 p1 (rnd (1 - 1)) 1 = p1.
Proof.
  intros F. unfold lerp. rewrite Rminus_diag_eq, rnd_0, Rmult_0_r, rnd_0, Rplus_0_l, Rmult_1_r by reflexivity.
  rewrite (rnd_F64 p1), (rnd_F64 p1); auto.
Qed.

(** The origin itself is at 0: so around.h compares with 0 where a or b is the origin. *)
Lemma q_origin n r0 r1 s : q n r0 r1 r0 r1 s = 0.
Proof.
  assert (M : forall y, minus rnd y y = Vec 0 0 0).
  { intros y. unfold minus. now rewrite (Rminus_diag_eq (x0 y)), (Rminus_diag_eq (x1 y)),
      (Rminus_diag_eq (x2 y)), rnd_0 by reflexivity. }
  assert (D : dot rnd n (Vec 0 0 0) = 0).
  { unfold dot; simpl. rewrite !Rmult_0_r, !rnd_0, !Rplus_0_r, !rnd_0. reflexivity. }
  unfold q, lerp. rewrite !M, D, !Rmult_0_l, rnd_0, Rplus_0_r. apply rnd_0.
Qed.

Section Direction.
Variable n : vec.
Variable reach : R.
Hypothesis n_F64 : F64s n.
Let R := size1 n * reach.

Lemma term_near k x r : F64 x -> F64 r -> Rabs (rnd (x - r)) <= reach ->
  near (1 + 2 * uu) (2050 * ee) (Rabs k * reach + tiny) (rnd (k * rnd (x - r))) (k * (x - r)).
Proof.
  intros X Y D. pose proof (difference_error x r reach X Y D) as E. pose proof tiny_pos as P.
  pose proof (Rabs_pos k) as K. pose proof (Rabs_pos (rnd (x - r))) as K'.
  assert (Q : 0 <= Rabs k * reach) by nra.
  apply near_rnd' with (b := 1) (d := 1025 * ee); [lra | split | lra | lra].
  - rewrite Rabs_mult. nra.
  - rewrite <- Rmult_minus_distr_l, Rabs_mult. nra.
Qed.

Lemma dot_near y r : F64s y -> F64s r -> each (within reach) (minus rnd y r) ->
  near (1 + 8 * uu) (4120 * ee) (R + 3 * tiny) (dot rnd n (minus rnd y r)) (dot exact n (minus exact y r)).
Proof.
  intros (Y0 & Y1 & Y2) (R0 & R1 & R2) (D0 & D1 & D2). unfold within in *. simpl in *.
  pose proof (term_near (x0 n) _ _ Y0 R0 D0) as T0. pose proof (term_near (x1 n) _ _ Y1 R1 D1) as T1.
  pose proof (term_near (x2 n) _ _ Y2 R2 D2) as T2.
  pose proof tiny_pos as P.
  assert (G : 0 <= reach) by (pose proof (Rabs_pos (rnd (x0 y - x0 r))); lra).
  assert (Q0 : 0 <= Rabs (x0 n) * reach) by (pose proof (Rabs_pos (x0 n)); nra).
  assert (Q1 : 0 <= Rabs (x1 n) * reach) by (pose proof (Rabs_pos (x1 n)); nra).
  assert (Q2 : 0 <= Rabs (x2 n) * reach) by (pose proof (Rabs_pos (x2 n)); nra).
  unfold dot, minus, exact; simpl.
  replace (R + 3 * tiny) with ((Rabs (x0 n) * reach + tiny) + (Rabs (x1 n) * reach + tiny) +
    (Rabs (x2 n) * reach + tiny)) by (unfold R, size1; ring).
  apply near_rnd' with (b := 1 + 4 * uu) (d := 3090 * ee); [lra | | lra | lra].
  apply near_plus; [ | revert T2; apply near_weak; lra].
  apply near_rnd' with (b := 1 + 2 * uu) (d := 2050 * ee); [lra | | lra | lra].
  now apply near_plus.
Qed.

Lemma q_near y0 y1 r0 r1 s : F64s y0 -> F64s y1 -> F64s r0 -> F64s r1 -> F64 s -> 0 <= s <= 1 ->
  each (within reach) (minus rnd y0 r0) -> each (within reach) (minus rnd y1 r1) ->
  near (1 + 16 * uu) (7220 * ee) (R + 3 * tiny) (q n y0 y1 r0 r1 s)
    (dot exact n (minus exact (at_time s y0 y1) (at_time s r0 r1))).
Proof.
  intros Y0 Y1 R0 R1 F Hs D0 D1.
  pose proof (dot_near _ _ Y0 R0 D0) as A. pose proof (dot_near _ _ Y1 R1 D1) as B.
  pose proof (complement_rnd s F Hs) as K. pose proof tiny_pos as P.
  assert (G : 0 <= R).
  { destruct D0 as (D & _). unfold within in D. simpl in D. pose proof (Rabs_pos (rnd (x0 y0 - x0 r0))).
    unfold R, size1. apply Rmult_le_pos; [ | lra].
    pose proof (Rabs_pos (x0 n)). pose proof (Rabs_pos (x1 n)). pose proof (Rabs_pos (x2 n)). lra. }
  assert (T : tiny <= R + 3 * tiny) by lra.
  pose proof (near_lerp _ _ _ _ _ _ _ _ _ T K A B ltac:(lra)) as C.
  replace (dot exact n (minus exact (at_time s y0 y1) (at_time s r0 r1)))
    with (lerp exact (dot exact n (minus exact y0 r0)) (dot exact n (minus exact y1 r1)) (1 - s) s)
    by (unfold lerp, dot, minus, at_time, exact; simpl; ring).
  revert C. apply near_weak; lra.
Qed.

Lemma F64_times_4 x : F64 x -> rnd (4 * x) = 4 * x.
Proof.
  intros F. apply rnd_F64. replace (4 * x) with (x * bpow radix2 2) by (change (bpow radix2 2) with 4; ring).
  apply mult_bpow_pos_exact_FLT; [exact F | lia].
Qed.

Lemma bound_lower : 0 <= reach -> 63 * uu * R + / 4398046511104 * tiny * (1 - 4 * uu) <= error_bound n reach.
Proof.
  intros G. destruct n_F64 as (F0 & F1 & F2). unfold error_bound. cbv zeta.
  pose proof tiny_pos as P.
  assert (L : error_least = / 4398046511104 * tiny).
  { replace (/ 4398046511104) with (bpow radix2 (-42)) by reflexivity. unfold error_least, tiny.
    rewrite <- bpow_plus. reflexivity. }
  pose proof (Rabs_pos (x0 n)) as A0. pose proof (Rabs_pos (x1 n)) as A1. pose proof (Rabs_pos (x2 n)) as A2.
  pose proof (rnd_plus _ _ (generic_format_abs _ _ _ F0) (generic_format_abs _ _ _ F1)) as E.
  set (s01 := rnd (Rabs (x0 n) + Rabs (x1 n))) in *.
  rewrite (Rabs_pos_eq (Rabs (x0 n) + Rabs (x1 n))) in E by lra. apply Rabs_le_inv in E.
  pose proof (rnd_plus s01 _ (F64_rnd _) (generic_format_abs _ _ _ F2)) as E'.
  rewrite (Rabs_pos_eq (s01 + Rabs (x2 n))) in E' by lra. apply Rabs_le_inv in E'.
  pose proof (F64_rnd (s01 + Rabs (x2 n))) as F.
  set (size := rnd (s01 + Rabs (x2 n))) in *.
  assert (S : size1 n * (1 - 3 * uu) <= size) by (unfold size1; lra).
  rewrite (F64_times_4 size F).
  assert (T : R * (1 - 3 * uu) <= size * reach).
  { unfold R. replace (size1 n * reach * (1 - 3 * uu)) with (size1 n * (1 - 3 * uu) * reach) by ring.
    now apply Rmult_le_compat_r. }
  assert (RP : 0 <= R) by (unfold R, size1; apply Rmult_le_pos; lra).
  assert (SP : 0 <= 4 * size * reach) by lra.
  pose proof (rnd_lower _ SP) as B1. pose proof (rnd_pos _ SP) as P1. set (g := rnd (4 * size * reach)) in *.
  replace error_share with (/ 562949953421312) by reflexivity.
  assert (GP : 0 <= / 562949953421312 * g) by lra.
  pose proof (rnd_lower _ GP) as B2. pose proof (rnd_pos _ GP) as P2.
  set (h := rnd (/ 562949953421312 * g)) in *.
  assert (HP : 0 <= h + error_least) by lra.
  pose proof (rnd_lower _ HP) as B3. rewrite L in *. lra.
Qed.

(** ** The claim of direction.h, at one time: fl(q(a) - q(b)) > error_bound *)
Theorem above a0 a1 b0 b1 r0 r1 s :
  F64s a0 -> F64s a1 -> F64s b0 -> F64s b1 -> F64s r0 -> F64s r1 -> F64 s -> 0 <= s <= 1 ->
  each (within reach) (minus rnd a0 r0) -> each (within reach) (minus rnd a1 r1) ->
  each (within reach) (minus rnd b0 r0) -> each (within reach) (minus rnd b1 r1) ->
  error_bound n reach < rnd (q n a0 a1 r0 r1 s - q n b0 b1 r0 r1 s) ->
  0 < dot exact n (minus exact (at_time s a0 a1) (at_time s b0 b1)).
Proof.
  intros A0 A1 B0 B1 R0 R1 F Hs DA0 DA1 DB0 DB1 H.
  pose proof (q_near _ _ _ _ _ A0 A1 R0 R1 F Hs DA0 DA1) as QA.
  pose proof (q_near _ _ _ _ _ B0 B1 R0 R1 F Hs DB0 DB1) as QB.
  assert (G : 0 <= reach).
  { destruct DA0 as (D & _). unfold within in D. pose proof (Rabs_pos (x0 (minus rnd a0 r0))). lra. }
  assert (RP : 0 <= R).
  { unfold R, size1. apply Rmult_le_pos; [ | lra].
    pose proof (Rabs_pos (x0 n)). pose proof (Rabs_pos (x1 n)). pose proof (Rabs_pos (x2 n)). lra. }
  pose proof (bound_lower G) as L. pose proof tiny_pos as P.
  pose proof (near_plus _ _ _ _ _ _ _ _ QA (near_opp _ _ _ _ _ QB)) as D.
  apply near_rnd in D; [ | lra]. destruct D as [_ D]. apply Rabs_le_inv in D.
  replace (dot exact n (minus exact (at_time s a0 a1) (at_time s b0 b1)))
    with (dot exact n (minus exact (at_time s a0 a1) (at_time s r0 r1)) +
          - dot exact n (minus exact (at_time s b0 b1) (at_time s r0 r1)))
    by (unfold dot, minus, at_time, exact; simpl; ring).
  fold (q n a0 a1 r0 r1 s - q n b0 b1 r0 r1 s) in D. lra.
Qed.

(** ** At both ends of an interval, and so in between *)
Theorem separates a0 a1 b0 b1 r0 r1 begin end_ :
  F64s a0 -> F64s a1 -> F64s b0 -> F64s b1 -> F64s r0 -> F64s r1 ->
  F64 begin -> F64 end_ -> 0 <= begin < end_ -> end_ <= 1 ->
  each (within reach) (minus rnd a0 r0) -> each (within reach) (minus rnd a1 r1) ->
  each (within reach) (minus rnd b0 r0) -> each (within reach) (minus rnd b1 r1) ->
  error_bound n reach < rnd (q n a0 a1 r0 r1 begin - q n b0 b1 r0 r1 begin) ->
  error_bound n reach < rnd (q n a0 a1 r0 r1 end_ - q n b0 b1 r0 r1 end_) ->
  forall s, begin <= s <= end_ -> 0 < dot exact n (minus exact (at_time s a0 a1) (at_time s b0 b1)).
Proof.
  intros A0 A1 B0 B1 R0 R1 Fb Fe Hb He DA0 DA1 DB0 DB1 H K s Hs.
  assert (Sb : 0 <= begin <= 1) by lra. assert (Se : 0 <= end_ <= 1) by lra.
  pose proof (above _ _ _ _ _ _ _ A0 A1 B0 B1 R0 R1 Fb Sb DA0 DA1 DB0 DB1 H) as U.
  pose proof (above _ _ _ _ _ _ _ A0 A1 B0 B1 R0 R1 Fe Se DA0 DA1 DB0 DB1 K) as V.
  assert (Lin : forall t, dot exact n (minus exact (at_time t a0 a1) (at_time t b0 b1)) =
    dot exact n (minus exact a0 b0) +
    t * (dot exact n (minus exact a1 b1) - dot exact n (minus exact a0 b0))).
  { intros t. unfold dot, minus, at_time, exact; simpl. ring. }
  rewrite (Lin begin) in U. rewrite (Lin end_) in V. rewrite (Lin s). clear Lin.
  set (g := dot exact n (minus exact a0 b0)) in *.
  set (k := dot exact n (minus exact a1 b1) - g) in *.
  destruct (Rle_lt_dec 0 k).
  - assert (0 <= (s - begin) * k) by (apply Rmult_le_pos; lra). lra.
  - assert (0 <= (end_ - s) * - k) by (apply Rmult_le_pos; lra). lra.
Qed.

End Direction.

(** ** In the plane: the third terms are absent, which is as if they were zero *)
Lemma plane_dot n0 n1 d0 d1 d2 :
  rnd (rnd (n0 * d0) + rnd (n1 * d1)) = dot rnd (Vec n0 n1 0) (Vec d0 d1 d2).
Proof.
  unfold dot; simpl. rewrite Rmult_0_l, rnd_0, Rplus_0_r. symmetry. apply rnd_F64, F64_rnd.
Qed.

Lemma plane_size n0 n1 : rnd (Rabs n0 + Rabs n1) = rnd (rnd (Rabs n0 + Rabs n1) + Rabs 0).
Proof. rewrite Rabs_R0, Rplus_0_r. symmetry. apply rnd_F64, F64_rnd. Qed.
