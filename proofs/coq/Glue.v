(* SPDX-License-Identifier: Apache-2.0 *)
(** * Windows of time, one after another

    A long motion is proved window by window.  If each window ends at the time, and
    with the positions, at which the next begins, then what is proved of the windows
    is true of all of the motion: [glue_sound] for two, [chain_sound] for any number.

    Notation: [s1] is the scene of the earlier window, [s2] that of the later.

    Not here: a computation that compares the windows; the theorems say what it has
    to compare. *)
Require Import ZArith List Bool Reals Lra Lia.
From Noli Require Import Spec Checker Sound.
Import ListNotations.
Open Scope Z_scope.

(** The second trajectory after the first, without the breakpoint that both have. *)
Definition glue_traj (tr1 tr2 : traj) : traj := tr1 ++ tl tr2.

(** One scene over the time of both; what a cell is, the first says. *)
Definition glue (s1 s2 : scene) : scene :=
  Scene (tbeg s1) (tend s2) (fun v => glue_traj (path s1 v) (path s2 v)) (same s1)
        (ncell s1) (cell s1) (label s1) (excluded s1) (eta s1) (ring s1).

(** The same cells, merged vertices, labels, exclusions, distance and ring, and each vertex of
    a cell has its last breakpoint in [s1], its first in [s2], at the time between them, at one
    position. *)
Record follows (s1 s2 : scene) : Prop := {
  same_time     : tend s1 = tbeg s2;
  same_number   : ncell s1 = ncell s2;
  same_cells    : forall i, 0 <= i < ncell s1 -> cell s1 i = cell s2 i;
  same_merged   : forall i v, 0 <= i < ncell s1 -> In v (cell s1 i) -> same s1 v = same s2 v;
  same_labels   : forall i, 0 <= i < ncell s1 -> label s1 i = label s2 i;
  same_excluded : excluded s1 = excluded s2;
  same_eta      : eta s1 = eta s2;
  same_ring     : ring s1 = ring s2;
  same_position : forall i v, 0 <= i < ncell s1 -> In v (cell s1 i) ->
    exists l p r, path s1 v = l ++ [(tend s1, p)] /\ path s2 v = (tend s1, p) :: r }.

(** ** Two windows *)

(** Up to the time between, the glued trajectory is the first. *)
Lemma glue_before l r T p t : forall t0 p0, (t <= IZR T)%R ->
  pos_from t0 p0 (l ++ (T, p) :: r) t = pos_from t0 p0 (l ++ [(T, p)]) t.
Proof.
  induction l as [|(t1, p1) l IH]; intros t0 p0 H; cbn.
  - now destruct (Rle_dec _ _).
  - destruct (Rle_dec _ _); auto.
Qed.

Lemma increasing_app l r T p : forall t0,
  increasing t0 (l ++ [(T, p)]) -> increasing T r -> increasing t0 (l ++ (T, p) :: r).
Proof. induction l as [|(t1, p1) l IH]; cbn; intros t0 H1 H2; [tauto|split; [|apply IH]; tauto]. Qed.

Lemma last_time_app l r T p : forall t0, last_time t0 (l ++ (T, p) :: r) = last_time T r.
Proof. induction l as [|(t1, p1) l IH]; cbn; auto. Qed.

(** What [follows] says of one vertex, with the first breakpoint apart. *)
Lemma glue_path s1 s2 i v : follows s1 s2 -> well_formed s1 -> well_formed s2 ->
  0 <= i < ncell s1 -> In v (cell s1 i) ->
  exists t0 p0 l p r, path s1 v = (t0, p0) :: l ++ [(tend s1, p)] /\ path s2 v = (tend s1, p) :: r /\
    path (glue s1 s2) v = (t0, p0) :: l ++ (tend s1, p) :: r /\
    t0 <= tbeg s1 /\ increasing t0 (l ++ (tend s1, p) :: r) /\ tend s2 <= last_time (tend s1) r.
Proof.
  intros F (L1 & _ & _ & _ & W1) (_ & _ & _ & _ & W2) Hi Hv.
  destruct (same_position s1 s2 F i v Hi Hv) as (l & p & r & E1 & E2).
  destruct (W1 i v Hi Hv) as [C1 _]. rewrite (same_number s1 s2 F) in Hi.
  rewrite (same_cells s1 s2 F) in Hv by now rewrite (same_number s1 s2 F).
  destruct (W2 i v Hi Hv) as [C2 _]. rewrite E2 in C2. destruct C2 as (_ & I2 & C2).
  unfold glue, glue_traj; cbn [path]. rewrite E1, E2 in *. destruct l as [|(t0, p0) l].
  - cbn in C1. lia.
  - cbn in C1. destruct C1 as (B & I1 & _). exists t0, p0, l, p, r. cbn [app tl].
    rewrite <- app_assoc. cbn [app]. repeat split; auto. now apply increasing_app.
Qed.

(** The vertex that stands for another does so in both windows. *)
Lemma glue_same s1 s2 i v : follows s1 s2 -> well_formed s1 -> well_formed s2 ->
  0 <= i < ncell s1 -> In v (cell s1 i) -> path (glue s1 s2) (same s1 v) = path (glue s1 s2) v.
Proof.
  intros F (_ & _ & _ & _ & W1) (_ & _ & _ & _ & W2) Hi Hv. unfold glue; cbn [path].
  destruct (W1 i v Hi Hv) as [_ ->]. rewrite (same_merged s1 s2 F i v Hi Hv).
  rewrite (same_cells s1 s2 F) in Hv by auto. rewrite (same_number s1 s2 F) in Hi.
  now destruct (W2 i v Hi Hv) as [_ ->].
Qed.

Lemma glue_well_formed s1 s2 : follows s1 s2 -> well_formed s1 -> well_formed s2 -> well_formed (glue s1 s2).
Proof.
  intros F W1 W2. split; [|split; [|split; [|split]]]; try apply W1.
  - cbn. pose proof (same_time s1 s2 F). destruct W1 as [? _], W2 as [? _]. lia.
  - intros i v Hi Hv. split; [|now apply (glue_same s1 s2 i)].
    destruct (glue_path s1 s2 i v F W1 W2 Hi Hv) as (t0 & p0 & l & p & r & _ & _ & -> & B & I & C).
    cbn. repeat split; auto. now rewrite last_time_app.
Qed.

(** A feature of a cell is where it is in the window of the time. *)
Lemma glue_simplex s1 s2 i P t : follows s1 s2 -> well_formed s1 -> well_formed s2 ->
  0 <= i < ncell s1 -> incl P (cell s1 i) ->
  ((t <= IZR (tend s1))%R -> simplex (glue s1 s2) P t = simplex s1 P t) /\
  ((IZR (tend s1) <= t)%R -> simplex (glue s1 s2) P t = simplex s2 P t).
Proof.
  intros F W1 W2 Hi HP. unfold simplex. split; intros T; f_equal; apply map_ext_in; intros v Hv;
    destruct (glue_path s1 s2 i v F W1 W2 Hi (HP v Hv)) as (t0 & p0 & l & p & r & E1 & E2 & E & _ & I & _);
    rewrite E; [rewrite E1|rewrite E2]; cbn [pos].
  - now apply glue_before.
  - now apply pos_from_later.
Qed.

(** The merged vertices of a feature are the same in both windows. *)
Lemma glue_merged s1 s2 i P : follows s1 s2 -> 0 <= i < ncell s1 -> incl P (cell s1 i) ->
  map (same s2) P = map (same s1) P.
Proof. intros F Hi I. apply map_ext_in. intros v Hv. symmetry. apply (same_merged s1 s2 F i); auto. Qed.

(** What is far is far in a scene with the same ring and no more edges. *)
Lemma far_fewer s1 s2 P Q : ring s1 = ring s2 -> (forall u v, joined s2 u v -> joined s1 u v) ->
  far_ids s1 P Q -> far_ids s2 P Q.
Proof.
  intros E J H u v Hu Hv W. apply (H u v Hu Hv). rewrite E. clear H Hu Hv.
  revert u W; induction (Z.to_nat (ring s2 - 1)) as [|n IH]; cbn; auto.
  intros u [->|(w & U & W)]; auto. right. exists w. auto.
Qed.

Lemma glue_joined s1 s2 u v : follows s1 s2 -> joined s2 u v -> joined s1 u v.
Proof.
  intros F (i & Hi & U & V). rewrite <- (same_number s1 s2 F) in Hi.
  rewrite <- (same_cells s1 s2 F) in U, V by auto.
  rewrite (glue_merged s1 s2 i) in U, V; auto using incl_refl. now exists i.
Qed.

(** Two windows that fit: what is true of each is true of both as one. *)
Theorem glue_sound strict s1 s2 : follows s1 s2 -> well_formed s1 -> well_formed s2 ->
  never_touch strict s1 -> never_touch strict s2 -> never_touch strict (glue s1 s2).
Proof.
  intros F W1 W2 N1 N2 t [A B] i j Hi Hj D E P Q IP IQ x y.
  cbn [glue tbeg tend same ncell cell label eta] in *.
  destruct (glue_simplex s1 s2 i P t F W1 W2 Hi IP) as [P1 P2].
  destruct (glue_simplex s1 s2 j Q t F W1 W2 Hj IQ) as [Q1 Q2].
  destruct (Rle_dec t (IZR (tend s1))) as [T|T].
  - rewrite P1, Q1 by auto. intros HP HQ.
    destruct (N1 t (conj A T) i j Hi Hj D E P Q IP IQ x y HP HQ) as [M1 M2]. split; auto.
    intros H. apply M2. now apply (far_fewer (glue s1 s2)).
  - assert (IZR (tend s1) <= t)%R as T' by lra. rewrite P2, Q2 by auto. intros HP HQ.
    pose proof (same_time s1 s2 F) as ST. rewrite ST in T'.
    assert (incl P (cell s2 i) /\ incl Q (cell s2 j)) as [IP2 IQ2]
      by now rewrite <- !(same_cells s1 s2 F) by auto.
    destruct (N2 t (conj T' B) i j) with (P := P) (Q := Q) (x := x) (y := y) as [M1 M2];
      rewrite <- ?(same_number s1 s2 F), <- ?(same_labels s1 s2 F) by auto; auto.
    + intros X; apply E. unfold is_excluded in *; cbn. now rewrite (same_excluded s1 s2 F).
    + rewrite (glue_merged s1 s2 i P F Hi IP), (glue_merged s1 s2 j Q F Hj IQ) in M1, M2.
      rewrite (same_eta s1 s2 F). split; auto. intros H. apply M2.
      apply (far_fewer (glue s1 s2)); auto; [apply F|]. intros u v. exact (glue_joined s1 s2 u v F).
Qed.

(** ** Any number of windows *)

(** All of the motion: the windows glued from the first on. *)
Fixpoint glue_all (s : scene) (l : list scene) : scene :=
  match l with
  | [] => s
  | s2 :: r => glue_all (glue s s2) r
  end.

(** Each window follows the one before it. *)
Fixpoint chain (s : scene) (l : list scene) : Prop :=
  match l with
  | [] => True
  | s2 :: r => follows s s2 /\ chain s2 r
  end.

(** What follows a window follows what ends with it. *)
Lemma follows_glue s1 s2 s3 : follows s1 s2 -> well_formed s1 -> well_formed s2 -> follows s2 s3 ->
  follows (glue s1 s2) s3.
Proof.
  intros F W1 W2 G. constructor; cbn.
  - apply G.
  - now rewrite (same_number s1 s2 F), (same_number s2 s3 G).
  - intros i Hi. rewrite (same_cells s1 s2 F), (same_cells s2 s3 G); auto.
    now rewrite <- (same_number s1 s2 F).
  - intros i v Hi Hv. rewrite (same_merged s1 s2 F i) by auto.
    rewrite (same_cells s1 s2 F) in Hv by auto. rewrite (same_number s1 s2 F) in Hi.
    now apply (same_merged s2 s3 G i).
  - intros i Hi. rewrite (same_labels s1 s2 F), (same_labels s2 s3 G); auto.
    now rewrite <- (same_number s1 s2 F).
  - now rewrite (same_excluded s1 s2 F), (same_excluded s2 s3 G).
  - now rewrite (same_eta s1 s2 F), (same_eta s2 s3 G).
  - now rewrite (same_ring s1 s2 F), (same_ring s2 s3 G).
  - intros i v Hi Hv.
    destruct (glue_path s1 s2 i v F W1 W2 Hi Hv) as (t0 & p0 & l & p & r & E1 & E2 & E & _).
    cbn [glue path] in E. rewrite E.
    destruct (same_position s2 s3 G i v) as (l' & q & r' & E3 & E4).
    { now rewrite <- (same_number s1 s2 F). }
    { now rewrite <- (same_cells s1 s2 F). }
    exists ((t0, p0) :: l ++ l'), q, r'. split; auto. rewrite <- E2, E3. cbn. now rewrite app_assoc.
Qed.

Lemma glue_all_sound strict l : forall s, chain s l ->
  Forall (fun w => well_formed w /\ never_touch strict w) (s :: l) ->
  well_formed (glue_all s l) /\ never_touch strict (glue_all s l).
Proof.
  assert (forall l s1 s2, follows s1 s2 -> well_formed s1 -> well_formed s2 -> chain s2 l ->
          chain (glue s1 s2) l) as C.
  { intros [|s3 l'] s1 s2 F W1 W2; cbn; auto. intros [G H]. split; auto. now apply follows_glue. }
  induction l as [|s2 l IH]; cbn; intros s H A.
  - now inversion A.
  - inversion A as [|? ? [W1 N1] A1]; inversion A1 as [|? ? [W2 N2] A2]; subst. destruct H as [F H].
    apply IH; [now apply C|]. constructor; auto.
    split; [now apply glue_well_formed|now apply glue_sound].
Qed.

Lemma last_any {A} (x d d' : A) l : last (x :: l) d = last (x :: l) d'.
Proof. revert x; induction l as [|y l IH]; intros x; [easy|]. exact (IH y). Qed.

(** The glued scene is over all of the time. *)
Lemma glue_all_time l : forall s,
  tbeg (glue_all s l) = tbeg s /\ tend (glue_all s l) = tend (last l s).
Proof.
  induction l as [|s2 l IH]; intros s; [easy|]. destruct (IH (glue s s2)) as [E1 E2].
  cbn [glue_all]. rewrite E1, E2. split; auto. destruct l as [|s3 l]; auto.
  change (last (s2 :: s3 :: l) s) with (last (s3 :: l) s). now rewrite (last_any s3 (glue s s2) s).
Qed.

(** Windows that were each accepted, and fit: nothing touches in all of the motion. *)
Theorem chain_sound strict s l : chain s l ->
  Forall (fun w => exists g toks, check strict w g toks = true) (s :: l) ->
  never_touch strict (glue_all s l).
Proof.
  intros C A. apply glue_all_sound; auto. eapply Forall_impl; [|apply A]. cbn. intros w (g & toks & H).
  split; [eapply check_well_formed|eapply check_sound]; eauto.
Qed.
