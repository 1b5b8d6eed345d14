(* SPDX-License-Identifier: Apache-2.0 *)
(** * kernel/orientation.cpp: a sign that the double filter is certain of is right

    Notation: that of Rounding.v and Formulas.v.  [permanent] is a determinant with sums of magnitudes
    in place of differences, as the code computes it.

    Points are any doubles: what underflow may add is in the bounds.

    Not here: overflow, where the code's comparison fails; rounding modes other than to nearest. *)
Require Import Reals Psatz.
From Flocq Require Import Core.
From NoliGappa Require Import Constants Rounding Formulas Differences.
Open Scope R_scope.

(** |left| + |right|, with left = a * d, right = b * c *)
Definition permanent2 (r : R -> R) a b c d := r (Rabs (r (a * d)) + Rabs (r (b * c))).

(** uz * (vw - wv) + vz * (wu - uw) + wz * (uv - vu) *)
Definition det3 (r : R -> R) u v w :=
  r (r (r (x2 u * det2 r (x0 v) (x1 v) (x0 w) (x1 w)) + r (x2 v * det2 r (x0 w) (x1 w) (x0 u) (x1 u)))
     + r (x2 w * det2 r (x0 u) (x1 u) (x0 v) (x1 v))).

Definition permanent3 (r : R -> R) u v w :=
  r (r (r (Rabs (x2 u) * permanent2 r (x0 v) (x1 v) (x0 w) (x1 w)) +
        r (Rabs (x2 v) * permanent2 r (x0 w) (x1 w) (x0 u) (x1 u)))
     + r (Rabs (x2 w) * permanent2 r (x0 u) (x1 u) (x0 v) (x1 v))).

(** error_2d * (|left| + |right|) + underflow_2d *)
Definition error2 r a b c d := r (r (error_2d * permanent2 r a b c d) + underflow_2d).

(** error_3d * size + underflow, with underflow = (|uz| + |vz| + |wz|) * underflow_3d + underflow_3d *)
Definition error3 r u v w :=
  r (r (error_3d * permanent3 r u v w) +
     r (r (r (r (Rabs (x2 u) + Rabs (x2 v)) + Rabs (x2 w)) * underflow_3d) + underflow_3d)).

(** ** Pieces *)

(** x is a computed difference of coordinates, y the exact one. *)
Definition differ x y := exists p q, F64 p /\ F64 q /\ x = rnd (p - q) /\ y = p - q.

Lemma differ_error x y : differ x y -> Rabs (x - y) <= 1025 * ee * Rabs x.
Proof. intros (p & q & P & Q & -> & ->). apply difference_error; [exact P | exact Q | lra]. Qed.

Lemma abs_product_error x y v w m d : Rabs (x - y) <= m -> Rabs (v - w) <= d ->
  Rabs (x * v - y * w) <= Rabs x * d + m * Rabs v + m * d.
Proof.
  intros A B. replace (x * v - y * w) with (x * (v - w) + (x - y) * v - (x - y) * (v - w)) by ring.
  pose proof (Rabs_triang (x * (v - w) + (x - y) * v) (- ((x - y) * (v - w)))) as T.
  pose proof (Rabs_triang (x * (v - w)) ((x - y) * v)) as T'.
  rewrite Rabs_Ropp, !Rabs_mult in *. unfold Rminus at 1.
  pose proof (Rabs_pos x). pose proof (Rabs_pos v). pose proof (Rabs_pos (x - y)).
  pose proof (Rabs_pos (v - w)).
  assert (Rabs x * Rabs (v - w) <= Rabs x * d) by (apply Rmult_le_compat_l; assumption).
  assert (Rabs (x - y) * Rabs v <= m * Rabs v) by (apply Rmult_le_compat_r; assumption).
  assert (Rabs (x - y) * Rabs (v - w) <= m * d) by (apply Rmult_le_compat; assumption). lra.
Qed.

(** A product of two differences, relative to what was computed: 3u. *)
Lemma product_error x y v w : differ x y -> differ v w ->
  Rabs (rnd (x * v) - y * w) <= 3080 * ee * Rabs (rnd (x * v)) + 2 * zz * tiny.
Proof.
  intros A B. apply differ_error in A. apply differ_error in B. pose proof tiny_pos.
  pose proof (abs_product_error _ _ _ _ _ _ A B) as E. pose proof (rnd_error (x * v)) as F.
  rewrite Rabs_mult in F. set (P := Rabs x * Rabs v) in *.
  assert (E' : Rabs (x * v - y * w) <= 2051 * ee * P).
  { apply Rle_trans with (1 := E). assert (0 <= P) by (apply Rmult_le_pos; apply Rabs_pos).
    replace (Rabs x * (1025 * ee * Rabs v)) with (1025 * ee * P) by (unfold P; ring).
    replace (1025 * ee * Rabs x * Rabs v) with (1025 * ee * P) by (unfold P; ring).
    replace (1025 * ee * Rabs x * (1025 * ee * Rabs v)) with (1025 * ee * (1025 * ee) * P)
      by (unfold P; ring). lra. }
  assert (G : P <= Rabs (rnd (x * v)) + Rabs (rnd (x * v) - x * v)).
  { unfold P. rewrite <- Rabs_mult. replace (x * v) with (rnd (x * v) + - (rnd (x * v) - x * v)) at 1 by ring.
    rewrite <- (Rabs_Ropp (rnd (x * v) - x * v)). apply Rabs_triang. }
  replace (rnd (x * v) - y * w) with ((rnd (x * v) - x * v) + (x * v - y * w)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). pose proof (Rabs_pos (rnd (x * v))). lra.
Qed.

Lemma det2_error a b c d a' b' c' d' : differ a a' -> differ b b' -> differ c c' -> differ d d' ->
  let G := Rabs (rnd (a * d)) + Rabs (rnd (b * c)) in
  Rabs (det2 rnd a b c d - det2 exact a' b' c' d') <= 4104 * ee * G + 4 * zz * tiny /\
  Rabs (det2 rnd a b c d) <= G * (1 + uu) /\ G * (1 - uu) <= permanent2 rnd a b c d /\ 0 <= G.
Proof.
  intros A B C D. cbv zeta. unfold det2, permanent2, exact.
  pose proof (product_error _ _ _ _ A D) as E. pose proof (product_error _ _ _ _ B C) as F.
  pose proof (F64_rnd (a * d)) as FE. pose proof (F64_rnd (b * c)) as FF.
  set (l := rnd (a * d)) in *. set (r := rnd (b * c)) in *.
  pose proof (rnd_minus l r FE FF) as M.
  pose proof (rnd_plus _ _ (generic_format_abs _ _ _ FE) (generic_format_abs _ _ _ FF)) as N.
  pose proof (Rabs_pos l). pose proof (Rabs_pos r).
  rewrite (Rabs_pos_eq (Rabs l + Rabs r)) in N by lra. apply Rabs_le_inv in N.
  assert (LR : Rabs (l - r) <= Rabs l + Rabs r).
  { unfold Rminus. rewrite <- (Rabs_Ropp r). apply Rabs_triang. }
  apply Rabs_le_inv in E. apply Rabs_le_inv in F.
  assert (M' : Rabs (rnd (l - r) - (l - r)) <= uu * (Rabs l + Rabs r)) by lra.
  apply Rabs_le_inv in M'. apply Rabs_le_inv in LR.
  repeat split; try (apply Rabs_le); lra.
Qed.

Lemma error2_lower a b c d : let G := Rabs (rnd (a * d)) + Rabs (rnd (b * c)) in
  G * (1 - uu) <= permanent2 rnd a b c d -> 0 <= G ->
  5 * uu * G + zz * tiny * 16 <= error2 rnd a b c d.
Proof.
  cbv zeta. intros H P. unfold error2. pose proof tiny_pos.
  set (G := Rabs (rnd (a * d)) + Rabs (rnd (b * c))) in *. set (S := permanent2 rnd a b c d) in *.
  replace error_2d with (2 * (3 + 16 * uu) * uu) by reflexivity.
  assert (L : underflow_2d = / 1048576 * tiny).
  { replace (/ 1048576) with (bpow radix2 (-20)) by reflexivity. unfold underflow_2d, tiny.
    rewrite <- bpow_plus. reflexivity. }
  assert (A : 0 <= 2 * (3 + 16 * uu) * uu * S) by lra.
  pose proof (rnd_lower _ A) as B. pose proof (rnd_pos _ A) as C.
  set (g := rnd (2 * (3 + 16 * uu) * uu * S)) in *.
  assert (D : 0 <= g + underflow_2d) by lra. pose proof (rnd_lower _ D) as E. lra.
Qed.

(** ** In the plane: u = b - a, v = c - a, computed; left = ux * vy, right = uy * vx *)
Theorem orientation_2d ux uy vx vy ux' uy' vx' vy' :
  differ ux ux' -> differ uy uy' -> differ vx vx' -> differ vy vy' ->
  error2 rnd ux uy vx vy < Rabs (det2 rnd ux uy vx vy) ->
  (0 < det2 rnd ux uy vx vy -> 0 < det2 exact ux' uy' vx' vy') /\
  (det2 rnd ux uy vx vy < 0 -> det2 exact ux' uy' vx' vy' < 0).
Proof.
  intros A B C D H. destruct (det2_error _ _ _ _ _ _ _ _ A B C D) as (E & _ & P & G).
  pose proof (error2_lower _ _ _ _ P G) as L. cbv zeta in L. pose proof tiny_pos.
  apply Rabs_le_inv in E. split; intros S.
  - rewrite Rabs_pos_eq in H by lra. lra.
  - rewrite Rabs_left in H by lra. lra.
Qed.

(** ** In space *)

Lemma term_error z z' a b c d a' b' c' d' :
  differ z z' -> differ a a' -> differ b b' -> differ c c' -> differ d d' ->
  exists A, 0 <= A /\
  Rabs (rnd (z * det2 rnd a b c d) - z' * det2 exact a' b' c' d')
    <= 6170 * ee * A + Rabs z * (8 * zz * tiny) + 2 * zz * tiny /\
  Rabs (rnd (z * det2 rnd a b c d)) <= A * (1 + 4 * uu) + zz * tiny /\
  A * (1 - 3 * uu) - zz * tiny <= rnd (Rabs z * permanent2 rnd a b c d).
Proof.
  intros Z A B C D. apply differ_error in Z. destruct (det2_error _ _ _ _ _ _ _ _ A B C D) as (E & F & P & G).
  set (g := Rabs (rnd (a * d)) + Rabs (rnd (b * c))) in *.
  set (v := det2 rnd a b c d) in *. set (w := det2 exact a' b' c' d') in *.
  set (p := permanent2 rnd a b c d) in *.
  pose proof tiny_pos as TP. pose proof (Rabs_pos z) as ZP. pose proof (Rabs_pos v) as VP.
  exists (Rabs z * g). assert (Q : 0 <= Rabs z * g) by (apply Rmult_le_pos; assumption).
  pose proof (abs_product_error _ _ _ _ _ _ Z E) as M. pose proof (rnd_error (z * v)) as N.
  rewrite Rabs_mult in N.
  assert (ZV : Rabs z * Rabs v <= Rabs z * g * (1 + uu)).
  { rewrite Rmult_assoc. now apply Rmult_le_compat_l. }
  assert (ZT : 0 <= Rabs z * tiny) by nra.
  assert (M' : Rabs (z * v - z' * w) <= 5140 * ee * (Rabs z * g) + Rabs z * (8 * zz * tiny)).
  { apply Rle_trans with (1 := M).
    replace (1025 * ee * Rabs z * Rabs v) with (1025 * ee * (Rabs z * Rabs v)) by ring.
    replace (Rabs z * (4104 * ee * g + 4 * zz * tiny))
      with (4104 * ee * (Rabs z * g) + 4 * zz * (Rabs z * tiny)) by ring.
    replace (1025 * ee * Rabs z * (4104 * ee * g + 4 * zz * tiny))
      with (1025 * ee * (4104 * ee) * (Rabs z * g) + 1025 * ee * (4 * zz) * (Rabs z * tiny)) by ring.
    replace (Rabs z * (8 * zz * tiny)) with (8 * zz * (Rabs z * tiny)) by ring. lra. }
  split; [exact Q | split; [ | split]].
  - replace (rnd (z * v) - z' * w) with ((rnd (z * v) - z * v) + (z * v - z' * w)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). lra.
  - replace (rnd (z * v)) with (z * v + (rnd (z * v) - z * v)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_mult. lra.
  - assert (ZG : Rabs z * g * (1 - uu) <= Rabs z * p).
    { rewrite Rmult_assoc. now apply Rmult_le_compat_l. }
    assert (ZP' : 0 <= Rabs z * p) by lra. pose proof (rnd_lower _ ZP'). lra.
Qed.

Theorem orientation_3d u v w u' v' w' :
  differ (x0 u) (x0 u') -> differ (x1 u) (x1 u') -> differ (x2 u) (x2 u') ->
  differ (x0 v) (x0 v') -> differ (x1 v) (x1 v') -> differ (x2 v) (x2 v') ->
  differ (x0 w) (x0 w') -> differ (x1 w) (x1 w') -> differ (x2 w) (x2 w') ->
  error3 rnd u v w < Rabs (det3 rnd u v w) ->
  (0 < det3 rnd u v w -> 0 < det3 exact u' v' w') /\ (det3 rnd u v w < 0 -> det3 exact u' v' w' < 0).
Proof.
  intros U0 U1 U2 V0 V1 V2 W0 W1 W2.
  destruct (term_error _ _ _ _ _ _ _ _ _ _ U2 V0 V1 W0 W1) as (A & PA & EA & TA & SA).
  destruct (term_error _ _ _ _ _ _ _ _ _ _ V2 W0 W1 U0 U1) as (B & PB & EB & TB & SB).
  destruct (term_error _ _ _ _ _ _ _ _ _ _ W2 U0 U1 V0 V1) as (C & PC & EC & TC & SC).
  unfold error3, permanent3, det3 at 1 2 4, det3.
  change (exact ?x) with x.
  set (a := rnd (x2 u * _)) in *. set (b := rnd (x2 v * _)) in *. set (c := rnd (x2 w * _)) in *.
  set (a' := x2 u' * _) in *. set (b' := x2 v' * _) in *. set (c' := x2 w' * _) in *.
  set (p := rnd (Rabs (x2 u) * _)) in *. set (q := rnd (Rabs (x2 v) * _)) in *.
  set (r := rnd (Rabs (x2 w) * _)) in *.
  assert (PP : forall z k l m o, 0 <= rnd (Rabs z * permanent2 rnd k l m o)).
  { intros. apply rnd_pos, Rmult_le_pos; [apply Rabs_pos | ]. apply rnd_pos.
    pose proof (Rabs_pos (rnd (k * o))). pose proof (Rabs_pos (rnd (l * m))). lra. }
  assert (Pp : 0 <= p) by apply PP. assert (Pq : 0 <= q) by apply PP. assert (Pr : 0 <= r) by apply PP.
  clear PP. clearbody a b c a' b' c' p q r. pose proof tiny_pos as T.
  pose proof (Rabs_pos (x2 u)). pose proof (Rabs_pos (x2 v)). pose proof (Rabs_pos (x2 w)).
  set (zu := Rabs (x2 u)) in *. set (zv := Rabs (x2 v)) in *. set (zw := Rabs (x2 w)) in *.
  clearbody zu zv zw.
  (* the bound *)
  assert (L : 13 * uu * (A + B + C) + (zu + zv + zw) * (20 * zz * tiny) + 100 * zz * tiny <=
    rnd (rnd (error_3d * rnd (rnd (p + q) + r)) +
         rnd (rnd (rnd (rnd (zu + zv) + zw) * underflow_3d) + underflow_3d))).
  { replace error_3d with (2 * (7 + 56 * uu) * uu) by reflexivity.
    assert (E : underflow_3d = 32768 * zz * tiny).
    { rewrite zz_is. change 32768 with (bpow radix2 15). unfold underflow_3d, tiny.
      rewrite <- !bpow_plus. reflexivity. }
    assert (S1 : 0 <= p + q) by lra. pose proof (rnd_lower _ S1). pose proof (rnd_pos _ S1).
    set (s1 := rnd (p + q)) in *.
    assert (S2 : 0 <= s1 + r) by lra. pose proof (rnd_lower _ S2). pose proof (rnd_pos _ S2).
    set (s2 := rnd (s1 + r)) in *.
    assert (S3 : 0 <= 2 * (7 + 56 * uu) * uu * s2) by lra. pose proof (rnd_lower _ S3).
    pose proof (rnd_pos _ S3).
    set (s3 := rnd (2 * (7 + 56 * uu) * uu * s2)) in *.
    assert (S4 : 0 <= zu + zv) by lra. pose proof (rnd_lower _ S4). pose proof (rnd_pos _ S4).
    set (s4 := rnd (zu + zv)) in *.
    assert (S5 : 0 <= s4 + zw) by lra. pose proof (rnd_lower _ S5). pose proof (rnd_pos _ S5).
    set (s5 := rnd (s4 + zw)) in *.
    assert (T1 : tiny <= 1) by (change 1 with (bpow radix2 0); apply bpow_le; lia).
    assert (S5' : (zu + zv + zw) * (1 - 3 * uu) - 2 * zz <= s5) by lra.
    assert (S5'' : ((zu + zv + zw) * (1 - 3 * uu) - 2 * zz) * tiny <= s5 * tiny).
    { apply Rmult_le_compat_r; lra. }
    assert (S6 : 0 <= s5 * underflow_3d) by (apply Rmult_le_pos; lra).
    pose proof (rnd_lower _ S6). pose proof (rnd_pos _ S6). set (s6 := rnd (s5 * underflow_3d)) in *.
    rewrite E in *.
    assert (S7 : 0 <= s6 + 32768 * zz * tiny) by lra. pose proof (rnd_lower _ S7). pose proof (rnd_pos _ S7).
    set (s7 := rnd (s6 + 32768 * zz * tiny)) in *.
    assert (S8 : 0 <= s3 + s7) by lra. pose proof (rnd_lower _ S8) as L8.
    set (M := A + B + C). assert (HM : M * (1 - 6 * uu) - 5 * zz * tiny <= s2) by (unfold M; lra).
    assert (HP : 0 <= M) by (unfold M; lra).
    assert (K3 : 13 * uu * (1 + 8 * uu) * M - 7 * zz * tiny <= s3) by lra.
    assert (ZP : 0 <= (zu + zv + zw) * tiny) by (apply Rmult_le_pos; lra).
    replace ((zu + zv + zw) * (20 * zz * tiny)) with (20 * zz * ((zu + zv + zw) * tiny)) by ring.
    set (Z := (zu + zv + zw) * tiny) in *.
    assert (K5 : Z * (1 - 3 * uu) - 2 * zz * tiny <= s5 * tiny).
    { replace (Z * (1 - 3 * uu) - 2 * zz * tiny) with (((zu + zv + zw) * (1 - 3 * uu) - 2 * zz) * tiny)
        by (unfold Z; ring). exact S5''. }
    set (k := s5 * tiny) in *. replace (s5 * (32768 * zz * tiny)) with (32768 * zz * k) in * by (unfold k;
      ring).
    assert (K6 : 32000 * zz * Z - 2 * zz * tiny <= s6) by lra.
    assert (K7 : 31000 * zz * Z + 32000 * zz * tiny <= s7) by lra.
    clear - K3 K7 L8 T HP ZP. lra. }
  intros H'. unfold exact.
  (* the determinant *)
  pose proof (rnd_error (a + b)) as E1. set (ab := rnd (a + b)) in *.
  pose proof (rnd_error (ab + c)) as E2. set (abc := rnd (ab + c)) in *.
  pose proof (Rabs_triang a b) as T1. pose proof (Rabs_triang ab c) as T2.
  assert (T3 : Rabs ab <= Rabs (a + b) + Rabs (ab - (a + b))).
  { replace ab with ((a + b) + (ab - (a + b))) at 1 by ring. apply Rabs_triang. }
  assert (F1 : Rabs (ab - (a + b)) <= 1030 * ee * (A + B) + 2 * zz * tiny) by lra.
  assert (F2 : Rabs (abc - (ab + c)) <= 1030 * ee * (A + B + C) + 3 * zz * tiny) by lra.
  clear E1 E2 T1 T2 T3 TA TB TC.
  replace (zu * (8 * zz * tiny)) with (8 * (zu * (zz * tiny))) in * by ring.
  replace (zv * (8 * zz * tiny)) with (8 * (zv * (zz * tiny))) in * by ring.
  replace (zw * (8 * zz * tiny)) with (8 * (zw * (zz * tiny))) in * by ring.
  replace ((zu + zv + zw) * (20 * zz * tiny))
    with (20 * (zu * (zz * tiny)) + 20 * (zv * (zz * tiny)) + 20 * (zw * (zz * tiny))) in * by ring.
  assert (ZT : 0 <= zz * tiny) by lra.
  assert (0 <= zu * (zz * tiny)) by (apply Rmult_le_pos; lra).
  assert (0 <= zv * (zz * tiny)) by (apply Rmult_le_pos; lra).
  assert (0 <= zw * (zz * tiny)) by (apply Rmult_le_pos; lra).
  apply Rabs_le_inv in F1. apply Rabs_le_inv in F2. apply Rabs_le_inv in EA. apply Rabs_le_inv in EB.
  apply Rabs_le_inv in EC. split; intros S.
  - rewrite Rabs_pos_eq in H' by lra. lra.
  - rewrite Rabs_left in H' by lra. lra.
Qed.
