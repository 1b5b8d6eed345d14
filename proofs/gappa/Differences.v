(* SPDX-License-Identifier: Apache-2.0 *)
(** * Differences of points whose coordinates are doubles

    Notation: that of Rounding.v and Formulas.v.

    Not here: coordinates that are not finite. *)
Require Import Reals.
From Flocq Require Import Core.
From NoliGappa Require Import Rounding Formulas.
Open Scope R_scope.

Definition F64s := each F64.

(** A computed difference of points of doubles, none of its components above m. *)
Lemma minus_error m a b : F64s a -> F64s b -> each (within m) (minus rnd a b) ->
  near 1 (1025 * ee) m (x0 (minus rnd a b)) (x0 (minus exact a b)) /\
  near 1 (1025 * ee) m (x1 (minus rnd a b)) (x1 (minus exact a b)) /\
  near 1 (1025 * ee) m (x2 (minus rnd a b)) (x2 (minus exact a b)).
Proof.
  intros (A0 & A1 & A2) (B0 & B1 & B2) (C0 & C1 & C2). unfold within, minus, exact in *; simpl in *.
  repeat split; try (rewrite Rmult_1_l; assumption); now apply difference_error.
Qed.

(** d is the computed difference of two points, e the exact one, and no component of d is above m. *)
Definition differs m d e := exists a b, F64s a /\ F64s b /\
  d = minus rnd a b /\ e = minus exact a b /\ each (within m) d.

Lemma differs_near m d e : differs m d e ->
  near 1 (1025 * ee) m (x0 d) (x0 e) /\ near 1 (1025 * ee) m (x1 d) (x1 e) /\
    near 1 (1025 * ee) m (x2 d) (x2 e).
Proof. intros (a & b & A & B & -> & -> & D). now apply minus_error. Qed.
