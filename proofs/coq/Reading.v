(* SPDX-License-Identifier: Apache-2.0 *)
(** * Scenes as they are read: the same checker, which makes long integers only of what is looked at

    Coordinates come from binary64 numbers, as short integers times powers of two.  In the unit of a step
    they are too long for the machine's integers; but bands (Checker.v) need the first bits of
    them alone, and settle nearly all tokens.  So here a vertex is read three times, if at all: once to see that it
    makes sense, once for its band, and, if a token asks for it, for its search tree.

    The theorem: [start_read_same], this start is that of Checker.v.

    Not here: how numbers and trajectories are found in a file. *)
Require Import ZArith List Bool Lia.
From Noli Require Import Spec Checker Sound.
Import ListNotations.
Open Scope Z_scope.

(** ** Definitions *)

(** A position: each coordinate is an integer times 2 to the power of another, which is not negative. *)
Record spot := Spot { xm : Z; xe : Z; ym : Z; ye : Z; zm : Z; ze : Z }.
Definition place (p : spot) : vec :=
  V3 (Z.shiftl (xm p) (xe p)) (Z.shiftl (ym p) (ye p)) (Z.shiftl (zm p) (ze p)).

(** A trajectory: its first breakpoint, and those after it. *)
Record reading := Reading { first_time : Z; first_spot : spot; later : delayed (list (Z * spot)) }.

(** The trajectory [l], in constant stack; [acc] has the earlier breakpoints, last first. *)
Fixpoint places (l : list (Z * spot)) (acc : traj) : traj :=
  match l with
  | [] => rev_append acc []
  | (t, p) :: r => places r ((t, place p) :: acc)
  end.
Definition traj_of (r : reading) : traj := (first_time r, place (first_spot r)) :: places (force (later r)) [].

(** A position in units of 2^s. *)
Definition coarse_part (s m e : Z) : Z := if e <? s then Z.shiftr m (s - e) else Z.shiftl m (e - s).
Definition coarse_spot (s : Z) (p : spot) : vec :=
  V3 (coarse_part s (xm p) (xe p)) (coarse_part s (ym p) (ye p)) (coarse_part s (zm p) (ze p)).

Section Read.
Variable read : Z -> reading.
Variable s : scene.

(** [wf_vertex], and [vertex_of].  The search tree is of a second reading, so that the first is not kept for it. *)
Definition wf_read (v : Z) : bool :=
  let r := read v in
  (first_time r <=? tbeg s) && reaches (first_time r) (tend s) (force (later r))
  && ((same s v =? v) || equal_traj (traj_of (read (same s v))) (traj_of r)).
Definition line_read (e : Z) (r : reading) : option band :=
  match chord_by (coarse_spot e) e (tbeg s) (tend s) ((first_time r, first_spot r) :: force (later r)) with
  | Some c => band_of c
  | None => None
  end.
Definition vertex_read (e v : Z) : vertex :=
  Vertex v (Delay (fun _ => index (traj_of (read v)))) (line_read e (read v)).

(** The stack before the first token. *)
Definition start_read : group -> option (list obligation) :=
  let first v := let r := read v in [(first_time r, place (first_spot r))] in
  start_by (build_by wf_read (unit_bits first) vertex_read s) s.

(** ** It is the same *)

Hypothesis path_read : forall v, path s v = traj_of (read v).

Lemma places_map l : forall acc, places l acc = rev_append acc (map (fun b => (fst b, place (snd b))) l).
Proof. induction l as [|(t, p) l IH]; intros acc; cbn; auto. now rewrite IH. Qed.

Lemma coarse_part_same e m k : 0 <= e -> coarse_part e m k = Z.shiftr (Z.shiftl m k) e.
Proof.
  intros E. unfold coarse_part. destruct (Z.ltb_spec k e).
  - destruct (Z.le_gt_cases 0 k).
    + now rewrite Z.shiftr_shiftl_r.
    + replace k with (- - k) at 2 by lia. rewrite Z.shiftl_opp_r, Z.shiftr_shiftr by auto. f_equal. lia.
  - now rewrite Z.shiftr_shiftl_l by lia.
Qed.

Lemma coarse_same e p : 0 <= e -> coarse_spot e p = coarse e (place p).
Proof. intros E. unfold coarse_spot, coarse, place; cbn. now rewrite !coarse_part_same. Qed.

Definition placed (l : list (Z * spot)) : traj := map (fun b => (fst b, place (snd b))) l.

Lemma strays_same e T0 W o w l : 0 <= e -> forall a b,
  strays (coarse_spot e) T0 W o w l a b = strays (coarse e) T0 W o w (placed l) a b.
Proof. intros E. induction l as [|(t, p) l IH]; intros a b; cbn; auto. now rewrite IH, coarse_same. Qed.

Lemma last_same l : forall t p, last_from t (place p) (placed l)
  = (fst (last_from t p l), place (snd (last_from t p l))).
Proof. induction l as [|(t1, p1) l IH]; intros t p; cbn; auto. Qed.

Lemma chord_same e T0 T1 l : 0 <= e -> chord_by (coarse_spot e) e T0 T1 l = chord_of e T0 T1 (placed l).
Proof.
  intros E. destruct l as [|(t, p) l]; auto. unfold chord_of, chord_by; cbn [placed map fst snd]. fold (placed l).
  rewrite last_same; cbn [fst snd]. now rewrite !coarse_same, strays_same.
Qed.

Lemma reaches_same T l : forall t, reaches t T (placed l) = reaches t T l.
Proof. induction l as [|(t1, p) l IH]; intros t; cbn; auto. now rewrite IH. Qed.

Lemma traj_of_placed r : traj_of r = placed ((first_time r, first_spot r) :: force (later r)).
Proof. unfold traj_of. now rewrite places_map. Qed.

Lemma wf_traj_same T0 T1 r :
  wf_traj T0 T1 (traj_of r) = (first_time r <=? T0) && reaches (first_time r) T1 (force (later r)).
Proof. unfold traj_of. rewrite places_map. cbn [wf_traj rev_append]. now rewrite <- reaches_same. Qed.

Lemma wf_same v : wf_read v = wf_vertex s v.
Proof. unfold wf_read, wf_vertex. now rewrite !path_read, wf_traj_same. Qed.

Lemma vertex_same e v : 0 <= e -> vertex_read e v = vertex_of s e v.
Proof.
  intros E. unfold vertex_read, vertex_of, line_read, line_of. rewrite path_read, chord_same by auto.
  now rewrite <- traj_of_placed.
Qed.

Lemma vertices_same e l : 0 <= e -> forall acc, vertices (vertex_read e) l acc = vertices (vertex_of s e) l acc.
Proof. intros E. induction l as [|v l IH]; intros acc; cbn [vertices]; auto. now rewrite IH, vertex_same. Qed.

Lemma unit_same l : unit_bits (fun v => [(first_time (read v), place (first_spot (read v)))]) l = unit_bits (path s) l.
Proof.
  unfold unit_bits. do 3 f_equal. generalize 0. induction l as [|v l IH]; intros m; cbn [fold_left]; auto.
  rewrite path_read. apply IH.
Qed.

Lemma build_same g :
  build_by wf_read (unit_bits (fun v => [(first_time (read v), place (first_spot (read v)))])) vertex_read s g = build s g.
Proof.
  unfold build, build_by. cbv zeta. rewrite unit_same, vertices_same by apply greater_left.
  replace (forallb wf_read _) with (forallb (wf_vertex s) (group_ids (fun v => v) s g)); auto.
  induction (group_ids _ s g) as [|v l IH]; cbn; auto. now rewrite IH, wf_same.
Qed.

Theorem start_read_same g : start_read g = start s g.
Proof. unfold start_read, start, start_by. cbv zeta. now rewrite build_same. Qed.

(** So what Sound.v says of [check] is true of it. *)
Theorem start_read_sound strict g toks st : start_read g = Some st -> run strict s st toks = Some [] ->
  well_formed s /\ never_touch strict s.
Proof.
  rewrite start_read_same. intros S R.
  assert (check strict s g toks = true) as C by (unfold check; now rewrite S, R).
  split; [now apply (check_well_formed strict s g toks)|now apply (check_sound strict s g toks)].
Qed.
End Read.
