(* SPDX-License-Identifier: Apache-2.0 *)
(** * Rounding to nearest in double, and errors relative to a scale

    Notation
      [rnd x]          x rounded to the nearest double, ties to even, subnormals kept
      [F64 x]          x is a double, if it does not overflow
      [uu]             2^-53;  [ee] is 2^-63, so that 1024 [ee] is [uu]: errors are counted in it
      [zz]             2^-95, the share of a scale that underflow may cost: a scale is at
                       least [tiny] = 2^-980, and a rounding loses at most 2^-1075 to underflow
      [near b d S v x] v is computed, x is what it stands for: |v| <= b S, |v - x| <= d S
      [within S v]     v is exact: |v| <= S
    A scale is any positive real, mostly a product of the largest magnitudes of inputs.  The
    tactic [gappa] knows no scales.  [rnd_scaled] is what lets it be used: a rounding of
    S x is S times something as near to x as rounding allows, whatever S is.  So [by_gappa]
    divides everything by its scale, and what it leaves has inputs of at most about 1.

    Not here: overflow.  [rnd] is round of Flocq without a greatest exponent. *)
Require Import Reals Psatz.
From Flocq Require Import Core Relative Plus_error Mult_error.
From Gappa Require Import Gappa_tactic.
From NoliGappa Require Import Constants.
Open Scope R_scope.

Global Instance prec_positive : Prec_gt_0 53.
Proof. reflexivity. Qed.

Definition rnd := round radix2 (FLT_exp (-1074) 53) ZnearestE.
Definition F64 := generic_format radix2 (FLT_exp (-1074) 53).

Notation uu := (/ 9007199254740992).
Notation ee := (/ 9223372036854775808).
Notation zz := (/ 39614081257132168796771975168).
Definition tiny := bpow radix2 (-980).

Definition near b d S v x := Rabs v <= b * S /\ Rabs (v - x) <= d * S.
Definition within S v := Rabs v <= S.

Ltac powers := simpl; unfold Z.pow_pos; simpl.

Lemma u_is : u = uu.
Proof. reflexivity. Qed.

Lemma tiny_pos : 0 < tiny.
Proof. apply bpow_gt_0. Qed.

Lemma zz_is : zz = bpow radix2 (-95).
Proof. reflexivity. Qed.

Lemma F64_rnd x : F64 (rnd x).
Proof. apply generic_format_round; typeclasses eauto. Qed.

Lemma rnd_F64 x : F64 x -> rnd x = x.
Proof. apply round_generic; typeclasses eauto. Qed.

Lemma F64_1 : F64 1.
Proof. change 1 with (bpow radix2 0). apply generic_format_FLT_bpow; [typeclasses eauto | lia]. Qed.

Lemma rnd_0 : rnd 0 = 0.
Proof. apply round_0; typeclasses eauto. Qed.

Lemma rnd_pos x : 0 <= x -> 0 <= rnd x.
Proof. intros H. rewrite <- rnd_0. apply round_le; [typeclasses eauto .. | exact H]. Qed.

(** ** One rounding *)

Lemma rnd_split x : exists w, Rabs (w - x) <= uu * Rabs x /\ Rabs (rnd x - w) <= zz * tiny.
Proof.
  destruct (error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun t => negb (Z.even t)) x)
    as (eps & eta & A & B & _ & E).
  exists (x * (1 + eps)). split.
  - replace (x * (1 + eps) - x) with (eps * x) by ring. rewrite Rabs_mult.
    apply Rmult_le_compat_r; [apply Rabs_pos | ].
    apply Rle_trans with (1 := A). powers. lra.
  - unfold rnd. rewrite E. replace (x * (1 + eps) + eta - x * (1 + eps)) with eta by ring.
    apply Rle_trans with (1 := B). rewrite zz_is. unfold tiny.
    replace (/ 2) with (bpow radix2 (-1)) by (simpl; lra).
    rewrite <- !bpow_plus. apply bpow_le. lia.
Qed.

Lemma rnd_error x : Rabs (rnd x - x) <= uu * Rabs x + zz * tiny.
Proof.
  destruct (rnd_split x) as (w & A & B).
  replace (rnd x - x) with ((rnd x - w) + (w - x)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma rnd_lower x : 0 <= x -> x * (1 - uu) - zz * tiny <= rnd x.
Proof.
  intros H. pose proof (rnd_error x) as A. rewrite (Rabs_pos_eq x H) in A.
  apply Rabs_le_inv in A. lra.
Qed.

(** Sums of doubles lose nothing to underflow. *)
Lemma rnd_plus x y : F64 x -> F64 y -> Rabs (rnd (x + y) - (x + y)) <= uu * Rabs (x + y).
Proof.
  intros Hx Hy.
  destruct (FLT_plus_error_N_ex radix2 (-1074) 53 (fun t => negb (Z.even t)) x y Hx Hy)
    as (eps & A & E).
  unfold rnd. rewrite E. replace ((x + y) * (1 + eps) - (x + y)) with (eps * (x + y)) by ring.
  rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos | ].
  apply Rle_trans with (1 := A). replace (u_ro radix2 53) with uu by (unfold u_ro; powers; lra).
  apply Rmult_le_reg_r with (1 + uu); [lra | ].
  replace (uu / (1 + uu) * (1 + uu)) with uu by (field; lra). lra.
Qed.

Lemma rnd_minus x y : F64 x -> F64 y -> Rabs (rnd (x - y) - (x - y)) <= uu * Rabs (x - y).
Proof. intros Hx Hy. apply rnd_plus; [exact Hx | ]. now apply generic_format_opp. Qed.

(** A computed difference of coordinates, with a bound of what was computed. *)
Lemma difference_error x y m :
  F64 x -> F64 y -> Rabs (rnd (x - y)) <= m -> Rabs (rnd (x - y) - (x - y)) <= 1025 * ee * m.
Proof.
  intros Hx Hy H. pose proof (rnd_minus x y Hx Hy) as A.
  set (d := rnd (x - y)) in *.
  assert (B : Rabs (x - y) <= Rabs d + Rabs (d - (x - y))).
  { replace (x - y) with (d + - (d - (x - y))) at 1 by ring.
    rewrite <- (Rabs_Ropp (d - (x - y))). apply Rabs_triang. }
  pose proof (Rabs_pos d). lra.
Qed.

(** ** Scales *)

Definition rounds v x := exists w, Rabs (w - x) <= uu * Rabs x /\ Rabs (v - w) <= zz.

Lemma rnd_scaled S x : tiny <= S -> exists v, rnd (S * x) = S * v /\ rounds v x.
Proof.
  intros H. pose proof tiny_pos as P. assert (Q : 0 < S) by lra.
  destruct (rnd_split (S * x)) as (w & A & B).
  exists (rnd (S * x) / S). split; [field; lra | ].
  exists (w / S). split.
  - replace (w / S - x) with ((w - S * x) / S) by (field; lra).
    rewrite Rabs_mult, (Rabs_pos_eq S) in A by lra.
    unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq S) by lra.
    apply Rmult_le_reg_r with S; [exact Q | ]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. lra.
  - replace (rnd (S * x) / S - w / S) with ((rnd (S * x) - w) / S) by (field; lra).
    unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq S) by lra.
    apply Rmult_le_reg_r with S; [exact Q | ]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    apply Rle_trans with (1 := B). apply Rmult_le_compat_l; lra.
Qed.

Lemma near_scaled b d S v x : 0 < S -> near b d S v x ->
  exists v' x', v = S * v' /\ x = S * x' /\ Rabs v' <= b /\ Rabs (v' - x') <= d.
Proof.
  intros P [A B]. exists (v / S), (x / S).
  assert (D : forall y c, Rabs y <= c * S -> Rabs (y / S) <= c).
  { intros y c H. unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq S) by lra.
    apply Rmult_le_reg_r with S; [exact P | ]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r; lra. }
  repeat split; [field; lra | field; lra | now apply D | ].
  replace (v / S - x / S) with ((v - x) / S) by (field; lra). now apply D.
Qed.

Lemma within_scaled S v : 0 < S -> within S v -> exists v', v = S * v' /\ Rabs v' <= 1.
Proof.
  intros P A. destruct (near_scaled 1 0 S v v P) as (v' & _ & E & _ & B & _); [ | now exists v'].
  unfold within in A. split; [lra | ]. rewrite Rminus_diag_eq, Rabs_R0; lra.
Qed.

Lemma scaled_near b d S v x : 0 < S ->
  Rabs v <= b -> Rabs (v - x) <= d -> near b d S (S * v) (S * x).
Proof.
  intros P A B. split.
  - rewrite Rabs_mult, (Rabs_pos_eq S), Rmult_comm by lra. apply Rmult_le_compat_r; lra.
  - rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq S), Rmult_comm by lra.
    apply Rmult_le_compat_r; lra.
Qed.

Lemma product_scaled S T a b : S * a * (T * b) = S * T * (a * b).
Proof. ring. Qed.
Lemma sum_scaled S a b : S * a + S * b = S * (a + b).
Proof. ring. Qed.
Lemma minus_scaled S a b : S * a - S * b = S * (a - b).
Proof. ring. Qed.
Lemma number_scaled S a b : a * (S * b) = S * (a * b).
Proof. ring. Qed.

(** *** The goal [near b d S v x], where v has [rnd] in it, with hypotheses [near] about the variables and
    [0 < S] or [tiny <= S] about scales *)
Ltac positive := first [assumption | apply Rlt_le_trans with tiny; [apply tiny_pos | assumption]].

Ltac scale_inputs := repeat match goal with
  | H : near _ _ _ ?v ?x |- _ =>
      let K := fresh in
      apply near_scaled in H; [destruct H as (? & ? & -> & -> & ? & K) | positive]
  | H : within _ ?v |- _ => apply within_scaled in H; [destruct H as (? & -> & ?) | positive] end.

(** x without its scales, which are the factors known to be positive. *)
Ltac scale_taken_out x := match x with
  | ?S * ?a => match goal with H : 0 < S |- _ => constr:(a) end
  | ?a + ?b => let a := scale_taken_out a in let b := scale_taken_out b in constr:(a + b)
  | ?a - ?b => let a := scale_taken_out a in let b := scale_taken_out b in constr:(a - b)
  | ?a * ?b => let a := scale_taken_out a in let b := scale_taken_out b in constr:(a * b)
  | IZR ?k => constr:(IZR k) end.

Ltac scale_exact := match goal with |- near _ _ ?S _ ?x =>
  let y := scale_taken_out x in replace x with (S * y) by ring end.

Ltac round_scaled S x := let v := fresh "v" in let w := fresh "w" in
  destruct (rnd_scaled S x) as (v & -> & w & ? & ?); [assumption | ].

Ltac scale_rounded := repeat match goal with
  | |- context [rnd (?S * ?a * (?T * ?b))] => rewrite (product_scaled S T a b); round_scaled (S * T) (a * b)
  | |- context [rnd (?S * ?a + ?S * ?b)] => rewrite (sum_scaled S a b); round_scaled S (a + b)
  | |- context [rnd (?S * ?a - ?S * ?b)] => rewrite (minus_scaled S a b); round_scaled S (a - b)
  | |- context [rnd (IZR ?k * (?S * ?a))] =>
      rewrite (number_scaled S (IZR k) a); round_scaled S (IZR k * a) end.

Ltac by_gappa := scale_inputs; scale_rounded; scale_exact; apply scaled_near; [positive | gappa | gappa].

(** ** Rules for what [gappa] is not needed for *)

Lemma near_weak b d b' d' S v x : 0 <= S -> b <= b' -> d <= d' -> near b d S v x -> near b' d' S v x.
Proof. intros P B D [H K]. split; nra. Qed.

Lemma near_scale b d S S' v x : 0 <= b -> 0 <= d -> S <= S' -> near b d S v x -> near b d S' v x.
Proof. intros P Q H [A B]. split; nra. Qed.

Lemma near_plus b d S T v w x y : near b d S v x -> near b d T w y -> near b d (S + T) (v + w) (x + y).
Proof.
  intros [A B] [C D]. split.
  - apply Rle_trans with (1 := Rabs_triang _ _). lra.
  - replace (v + w - (x + y)) with ((v - x) + (w - y)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma near_opp b d S v x : near b d S v x -> near b d S (- v) (- x).
Proof.
  intros [A B]. split; [now rewrite Rabs_Ropp | ].
  replace (- v - - x) with (- (v - x)) by ring. now rewrite Rabs_Ropp.
Qed.

Lemma near_rnd b d S v x : tiny <= S -> near b d S v x ->
  near (b * (1 + uu) + zz) (d + b * uu + zz) S (rnd v) x.
Proof.
  intros T [A B]. pose proof (rnd_error v) as E. pose proof (Rabs_pos v). pose proof tiny_pos. split.
  - replace (rnd v) with (v + (rnd v - v)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). lra.
  - replace (rnd v - x) with ((v - x) + (rnd v - v)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma near_rnd' b d b' d' S v x : tiny <= S -> near b d S v x ->
  b * (1 + uu) + zz <= b' -> d + b * uu + zz <= d' -> near b' d' S (rnd v) x.
Proof.
  intros T N B D. pose proof tiny_pos. apply (near_rnd b d S v x T) in N. revert N. apply near_weak; lra.
Qed.

(** A computed value above its error has the sign of what it stands for. *)
Lemma near_positive b d S v x : near b d S v x -> d * S < v -> 0 < x.
Proof. intros [_ B] H. apply Rabs_le_inv in B. lra. Qed.
