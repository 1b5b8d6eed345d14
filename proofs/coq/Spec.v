(* SPDX-License-Identifier: Apache-2.0 *)
(** * What is claimed: a scene, and that nothing in it touches, or comes near

    This file is all that a reader has to believe about the meaning of the checker's answer:
    a scene is made of integers, in units of its choice; its time and space are real.

    Notation: [t] is a time; [u], [v], [w] are vertex ids, [i], [j] cell ids, [l], [m] labels.
    Not here: how a claim is proved (Checker.v), and how a scene is read. *)
Require Import ZArith List Reals.
Import ListNotations.
Open Scope Z_scope.

(** ** The scene *)

(** A vector with integer coordinates: a position, or a direction. *)
Record vec := V3 { vx : Z; vy : Z; vz : Z }.

(** A trajectory is its breakpoints, time and position, in order of time. *)
Definition traj := list (Z * vec).

(** A scene is an interval of time, the vertices' trajectories, and cells: the faces, and the
    edges and points that belong to no face.  A cell is a list of vertex ids of any length; it
    has a label, and [excluded] lists the unordered pairs of labels about which nothing is
    claimed.  Vertices that are always at one place may be merged: [same] gives for each the one
    that stands for it.  Things are to be more than [eta] apart; [eta] = 0 says that they do not
    touch, and of things with fewer than [ring] edges between them only that is said. *)
Record scene := Scene {
  tbeg     : Z;              (* the claim begins here    *)
  tend     : Z;              (* and ends here            *)
  path     : Z -> traj;      (* of each vertex id        *)
  same     : Z -> Z;         (* stands for a vertex      *)
  ncell    : Z;              (* cells are 0 .. ncell-1   *)
  cell     : Z -> list Z;    (* vertex ids of a cell     *)
  label    : Z -> Z;         (* label of a cell          *)
  excluded : list (Z * Z);   (* unordered pairs          *)
  eta      : Z;              (* least distance, or 0     *)
  ring     : Z               (* as many edges, then eta  *)
}.

(** ** Scenes that make sense: a claim is proved of no other *)

(** The times of the breakpoints [r], which follow one at [t0], increase strictly. *)
Fixpoint increasing (t0 : Z) (r : traj) : Prop :=
  match r with [] => True | (t1, _) :: r' => t0 < t1 /\ increasing t1 r' end.

(** The time of the last of a breakpoint at [t0] and those in [r] after it. *)
Fixpoint last_time (t0 : Z) (r : traj) : Z :=
  match r with [] => t0 | (t1, _) :: r' => last_time t1 r' end.

(** A trajectory has strictly increasing times, from [T0] or before to [T1] or after. *)
Definition covers_time (T0 T1 : Z) (tr : traj) : Prop :=
  match tr with
  | [] => False
  | (t0, _) :: r => t0 <= T0 /\ increasing t0 r /\ T1 <= last_time t0 r
  end.

(** A scene is well formed if its interval has a length, it has a cell, its least distance is not
    negative, [ring] is positive, and each vertex of each cell has a trajectory for all of the
    interval, which is also that of the vertex that stands for it. *)
Definition well_formed (s : scene) : Prop :=
  tbeg s < tend s /\ 0 < ncell s /\ 0 <= eta s /\ 0 < ring s /\
  forall i v, 0 <= i < ncell s -> In v (cell s i) ->
    covers_time (tbeg s) (tend s) (path s v) /\ path s (same s v) = path s v.

(** ** Which features are neighbours: ids are those that stand for others *)

(** Two lists of vertex ids have none in common. *)
Definition disjoint_ids (P Q : list Z) : Prop := forall v, In v P -> ~ In v Q.

(** Two vertices are joined by an edge if there is a cell that has both, after merging. *)
Definition joined (s : scene) (u v : Z) : Prop :=
  exists i, 0 <= i < ncell s /\ In u (map (same s) (cell s i)) /\ In v (map (same s) (cell s i)).

(** There is a way of at most [n] edges from [u] to [v]. *)
Fixpoint within (s : scene) (n : nat) (u v : Z) : Prop :=
  match n with
  | O => u = v
  | S n' => u = v \/ exists w, joined s u w /\ within s n' w v
  end.

(** All ways from a vertex in [P] to one in [Q] have at least [ring] edges. *)
Definition far_ids (s : scene) (P Q : list Z) : Prop :=
  forall u v, In u P -> In v Q -> ~ within s (Z.to_nat (ring s - 1)) u v.

(** ** Its meaning over the real numbers *)
Open Scope R_scope.

(** A point of space. *)
Record pt := P3 { px : R; py : R; pz : R }.

(** The point with the coordinates of an integer vector. *)
Definition inj (p : vec) : pt := P3 (IZR (vx p)) (IZR (vy p)) (IZR (vz p)).

(** The point (1-u) p + u q: [p] for u = 0, [q] for u = 1. *)
Definition mix (u : R) (p q : pt) : pt :=
  P3 ((1 - u) * px p + u * px q) ((1 - u) * py p + u * py q) ((1 - u) * pz p + u * pz q).

(** The position at time [t] of a vertex that is at [p0] at time [t0] and then
    goes in straight lines, each at constant speed, through the breakpoints [r]. *)
Fixpoint pos_from (t0 : Z) (p0 : vec) (r : traj) (t : R) : pt :=
  match r with
  | [] => inj p0
  | (t1, p1) :: r' =>
      if Rle_dec t (IZR t1)
      then mix ((t - IZR t0) / (IZR t1 - IZR t0)) (inj p0) (inj p1)
      else pos_from t1 p1 r' t
  end.

(** The position of a trajectory at time [t]. *)
Definition pos (tr : traj) (t : R) : pt :=
  match tr with [] => P3 0 0 0 | (t0, p0) :: r => pos_from t0 p0 r t end.

(** The sum of a list of weights. *)
Fixpoint sum (w : list R) : R := match w with [] => 0 | a :: r => a + sum r end.

(** The sum of points, each times its weight. *)
Fixpoint comb (w : list R) (l : list pt) : pt :=
  match w, l with
  | a :: w', p :: l' =>
      let q := comb w' l' in P3 (a * px p + px q) (a * py p + py q) (a * pz p + pz q)
  | _, _ => P3 0 0 0
  end.

(** [x] is in the convex hull of the points [l]: it is their sum with weights that are not
    negative and add up to 1. *)
Definition hull (l : list pt) (x : pt) : Prop :=
  exists w, length w = length l /\ Forall (fun a => 0 <= a) w /\ sum w = 1 /\ x = comb w l.

(** The points, at time [t], of the feature (vertex, edge, face, ...) with the vertices [P]. *)
Definition simplex (s : scene) (P : list Z) (t : R) : pt -> Prop :=
  hull (map (fun v => pos (path s v) t) P).

(** The square of the distance of two points. *)
Definition dist2 (p q : pt) : R := (px p - px q) ^ 2 + (py p - py q) ^ 2 + (pz p - pz q) ^ 2.

(** The pair of labels [l], [m] is among those about which nothing is claimed. *)
Definition is_excluded (s : scene) (l m : Z) : Prop := In (l, m) (excluded s) \/ In (m, l) (excluded s).

(** At all times of the interval, a feature of a cell [i] and a feature of a cell [j] that share
    no vertex, after merging, have no point in common; and if there are at least [ring] edges
    between them, they are more than [eta] apart; unless the labels of [i] and [j] are excluded.
    This is said of two different cells and, if [strict], also of two features of one cell. *)
Definition never_touch (strict : bool) (s : scene) : Prop :=
  forall t, IZR (tbeg s) <= t <= IZR (tend s) ->
  forall i j, (0 <= i < ncell s)%Z -> (0 <= j < ncell s)%Z ->
  strict = true \/ i <> j -> ~ is_excluded s (label s i) (label s j) ->
  forall P Q, incl P (cell s i) -> incl Q (cell s j) ->
  forall x y, simplex s P t x -> simplex s Q t y ->
  let P' := map (same s) P in let Q' := map (same s) Q in
  (disjoint_ids P' Q' -> 0 < dist2 x y) /\ (far_ids s P' Q' -> IZR (eta s) ^ 2 < dist2 x y).
