(* SPDX-License-Identifier: Apache-2.0 *)
(** * A claim that is at least as strong as the one that is asked implies it

    Of proofs/FORMAT.md, section 6, the fields that a scene and [strict] have: strict, distance, ring, excluded, and
    among times, that of fewer steps.  The others (motion, dimension, points, merged) are about how a scene is made. *)
Require Import ZArith List Reals Lra Lia.
From Noli Require Import Spec.
Import ListNotations.
Open Scope Z_scope.

(** The scene [s] with another claim: another interval, list of excluded pairs, least distance and ring. *)
Definition asked (s : scene) (T0 T1 : Z) (e : list (Z * Z)) (d r : Z) : scene :=
  Scene T0 T1 (path s) (same s) (ncell s) (cell s) (label s) e d r.

(** More edges reach no less. *)
Lemma within_more s u v n m : (n <= m)%nat -> within s n u v -> within s m u v.
Proof.
  revert u m; induction n as [| n IH]; intros u [| m] Hnm H; simpl in *; try lia; auto.
  destruct H as [H | (w & J & W)]; [now left |].
  right; exists w; split; [exact J |]; apply IH; [lia | exact W].
Qed.

(** Neither the interval nor the rest of the claim says which vertices are joined. *)
Lemma within_asked s T0 T1 e d r n u v : within (asked s T0 T1 e d r) n u v <-> within s n u v.
Proof.
  revert u; induction n as [| n IH]; intros u; simpl; [tauto |].
  split; intros [H | (w & J & W)]; (now left) || (right; exists w; split; [exact J | now apply IH]).
Qed.

Theorem asked_holds strict strict' s T0 T1 e d r :
  tbeg s <= T0 -> T1 <= tend s ->
  (strict' = true -> strict = true) ->
  (forall l m, is_excluded s l m -> is_excluded (asked s T0 T1 e d r) l m) ->
  0 <= d <= eta s -> ring s <= r ->
  never_touch strict s -> never_touch strict' (asked s T0 T1 e d r).
Proof.
  intros H0 H1 Hs He Hd Hr H t Ht i j Hi Hj Hij Hx P Q HP HQ x y X Y P' Q'.
  assert (Ht' : (IZR (tbeg s) <= t <= IZR (tend s))%R).
  { destruct Ht as [A B]; cbn in A, B; apply IZR_le in H0, H1; lra. }
  assert (Hij' : strict = true \/ i <> j) by tauto.
  assert (Hx' : ~ is_excluded s (label s i) (label s j)) by (intro A; apply Hx; now apply He).
  destruct (H t Ht' i j Hi Hj Hij' Hx' P Q HP HQ x y X Y) as [Apart Far].
  split; [exact Apart |].
  intros F.
  assert (Far' : (IZR (eta s) ^ 2 < dist2 x y)%R).
  { apply Far; intros u v Hu Hv W; apply (F u v Hu Hv).
    apply within_asked; cbn; apply within_more with (2 := W); lia. }
  change (IZR d ^ 2 < dist2 x y)%R; apply Rle_lt_trans with (2 := Far').
  destruct Hd as [D0 D1]; apply IZR_le in D0, D1.
  apply pow_incr; split; assumption.
Qed.
