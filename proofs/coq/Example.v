(* SPDX-License-Identifier: Apache-2.0 *)
(** * Small scenes: what is accepted, and what is refused

    Each token is used in a proof that is accepted; each condition of the checker is
    broken, alone, in one that is refused.  All is computed inside Coq, so that this
    file compiles only if the checker answers as it says.

    Notation: a group is written with [+], cells as [#i]; half spaces, directions
    and tokens as in Checker.v.

    Not here: the reading of files. *)
Require Import ZArith List.
From Noli Require Import Spec Checker Sound Reading Glue Poly Hit.
Import ListNotations.
Open Scope Z_scope.

Declare Scope group_scope.
Notation "x + y" := (Join x y) : group_scope.
Notation "# i" := (Cell i) (at level 5) : group_scope.
Delimit Scope group_scope with group.
Bind Scope group_scope with group.
Arguments check _ _ _%group _.
Arguments start _ _%group.

(** Whether a scene is accepted, not strict unless said. *)
Definition lax := check false.

Ltac computed := vm_compute; reflexivity.

(** A scene in which things are to be more than a distance apart, and no vertices are merged. *)
Definition spaced t0 t1 p n c l e eta := Scene t0 t1 p (fun v => v) n c l e eta 1.

(** The same in which things are not to touch. *)
Definition touching t0 t1 p n c l e := spaced t0 t1 p n c l e 0.

(** A vertex without a chord. *)
Definition bare v tr := Vertex v (Delay (fun _ => index tr)) None.

(** ** A triangle at rest, and a point that falls towards it *)

Definition at_rest p : traj := [(0, p); (4, p)].

Definition tri v := at_rest (match v with 0 => V3 0 0 0 | 1 => V3 8 0 0 | _ => V3 0 8 0 end).

(** The triangle is cell 0, the point, vertex 3, is cell 1. *)
Definition over_tri (tr : traj) : scene :=
  touching 0 4 (fun v => if v =? 3 then tr else tri v) 2 (fun i => if i =? 0 then [0; 1; 2] else [3])
        (fun i => i) [].

Definition fall z := over_tri [(0, V3 2 2 8); (1, V3 2 2 8); (4, V3 2 2 z)].
Definition up := V3 0 0 1.
Definition down := V3 0 0 (-1).
Definition plane n t z := TPlane (HalfSpace n t z) 0.
Definition above z := plane up 0 z.
Definition below z := plane down 0 (- z).
Definition point_first := (#1 + #0)%group.
Definition tri_first := (#0 + #1)%group.
Definition close tok := [TParts; TOne; tok; TOne].

Lemma ok_plane : lax (fall 2) point_first (close (above 1)) = true. Proof. computed. Qed.
Lemma ok_direction : lax (fall 2) point_first (close (TDirection up)) = true. Proof. computed. Qed.
Lemma ok_plane_down : lax (fall 2) tri_first (close (below 1)) = true. Proof. computed. Qed.
Lemma ok_direction_down : lax (fall 2) tri_first (close (TDirection down)) = true. Proof. computed. Qed.
Theorem safe : never_touch false (fall 2).
Proof. exact (check_sound _ _ _ _ ok_plane). Qed.
Theorem safe_well_formed : well_formed (fall 2).
Proof. exact (check_well_formed _ _ _ _ ok_plane). Qed.

(** A plane moves with its time: this one is between a point and another it follows. *)
Definition two_points (tr0 tr1 : traj) : scene :=
  touching 0 4 (fun v => if v =? 0 then tr0 else tr1) 2 (fun i => [i]) (fun i => i) [].
Definition race := two_points [(0, V3 0 0 0); (4, V3 40 0 0)] [(0, V3 2 0 0); (4, V3 42 0 0)].
Definition moving nd := plane (V3 (-1) 0 0) 10 nd.
Lemma ok_moving : lax race tri_first (close (moving (-1))) = true. Proof. computed. Qed.
Lemma ok_moving_other : lax race point_first (close (plane (V3 1 0 0) (-10) 1)) = true. Proof. computed. Qed.
Lemma no_not_moving : lax race tri_first (close (plane (V3 (-1) 0 0) 0 (-1))) = false.
Proof. computed. Qed.
Lemma no_moving_zero : lax race tri_first (close (moving 0)) = false. Proof. computed. Qed.
Lemma no_moving_zero_second : lax race tri_first (close (moving (-2))) = false. Proof. computed. Qed.

(** Planes with the value 0 somewhere: at the point's last position, at the triangle. *)
Lemma no_plane_zero : lax (fall 2) point_first (close (above 2)) = false. Proof. computed. Qed.
Lemma no_plane_zero_second : lax (fall 2) point_first (close (above 0)) = false. Proof. computed. Qed.
Lemma no_plane_side : lax (fall 2) point_first (close (below 1)) = false. Proof. computed. Qed.
Lemma no_plane : lax (fall (-2)) point_first (close (above 1)) = false. Proof. computed. Qed.
Lemma no_direction : lax (fall (-2)) point_first (close (TDirection up)) = false. Proof. computed. Qed.
Lemma no_direction_side : lax (fall 2) point_first (close (TDirection down)) = false. Proof. computed. Qed.

(** A point that rises from the plane. *)
Definition rise := over_tri [(0, V3 2 2 1); (4, V3 2 2 8)].
Lemma ok_rise : lax rise point_first (close (TDirection up)) = true. Proof. computed. Qed.
Lemma no_rise : lax rise point_first (close (above 1)) = false. Proof. computed. Qed.

(** A point that is above at both ends, and at 0 or below at a breakpoint between. *)
Definition dip z := over_tri [(0, V3 2 2 8); (1, V3 2 2 z); (4, V3 2 2 8)].
Lemma ok_dip : lax (dip 1) point_first (close (TDirection up)) = true. Proof. computed. Qed.
Lemma ok_dip_plane : lax (dip 2) point_first (close (above 1)) = true. Proof. computed. Qed.
Lemma no_dip : lax (dip (-1)) point_first (close (TDirection up)) = false. Proof. computed. Qed.
Lemma no_dip_zero : lax (dip 0) point_first (close (TDirection up)) = false. Proof. computed. Qed.
Lemma no_dip_second : lax (dip (-1)) tri_first (close (TDirection down)) = false. Proof. computed. Qed.
Lemma no_dip_plane : lax (dip 1) point_first (close (above 1)) = false. Proof. computed. Qed.
Lemma no_dip_plane_second : lax (dip 1) tri_first (close (below 1)) = false. Proof. computed. Qed.

(** Values with different denominators: breakpoints of one inside segments of the other. *)
Definition cross z := two_points [(0, V3 0 0 0); (4, V3 0 0 8)]
  [(0, V3 0 0 6); (1, V3 0 0 z); (3, V3 0 0 12); (4, V3 0 0 9)].
Lemma ok_cross : lax (cross 3) point_first (close (TDirection up)) = true. Proof. computed. Qed.
Lemma no_cross : lax (cross 2) point_first (close (TDirection up)) = false. Proof. computed. Qed.
Lemma ok_cross_second : lax (cross 3) tri_first (close (TDirection down)) = true. Proof. computed. Qed.
Lemma no_cross_second : lax (cross 2) tri_first (close (TDirection down)) = false. Proof. computed. Qed.

(** What the checker asks of the times at which it compares, which are always so. *)
Definition zigzag : traj := [(0, V3 0 0 0); (1, V3 0 0 9); (2, V3 0 0 0); (3, V3 0 0 9)].
Definition values_of a b cs := values up a b 1 cs (index zigzag).
Lemma ok_values : values_of 0 3 [0; 1; 2; 3] = Some [(0, 1); (9, 1); (0, 1); (9, 1)]. Proof. computed. Qed.
Lemma ok_values_between : values up 1 5 2 [1; 2; 3; 4; 5] (index zigzag)
  = Some [(9, 2); (9, 1); (9, 2); (0, 1); (9, 2)].
Proof. computed. Qed.
Lemma no_values_breakpoint : values_of 0 3 [0; 1; 3] = None. Proof. computed. Qed.
Lemma no_values_order : values_of 0 3 [0; 1; 0; 1; 2; 3] = None. Proof. computed. Qed.
Lemma no_values_end : values_of 0 3 [0; 1; 2] = None. Proof. computed. Qed.
Lemma no_values_begin : values_of (-1) 3 [0; 1; 2; 3] = None. Proof. computed. Qed.
Lemma no_values_after : values_of 0 4 [0; 1; 2; 3; 4] = None. Proof. computed. Qed.
Lemma no_lengths : orb (all_less 0 [] [(1, 1)]) (all_less 0 [(0, 1)] []) = false. Proof. computed. Qed.

(** The search in trajectories of any number of breakpoints, which are at the times 3, 6, 9, ... *)
Definition long (n : nat) : traj := map (fun k => (3 * Z.of_nat k, V3 (Z.of_nat k) 0 0)) (seq 1 n).
Definition begins (n : nat) (a : Z) : option Z :=
  match since 2 a (index (long n)) with (t, _) :: _ => Some t | [] => None end.
Definition expected (n : nat) (a : Z) : option Z := Some (3 * Z.max 1 (Z.min (Z.of_nat n) (a / 6))).
Lemma ok_since : forallb (fun n => forallb (fun a =>
  match begins n (Z.of_nat a), expected n (Z.of_nat a) with Some t, Some u => t =? u | _, _ => false end)
  (seq 0 120)) (seq 1 18) = true.
Proof. computed. Qed.
Lemma no_since : since 2 7 (index []) = []. Proof. computed. Qed.

(** Of 1000 breakpoints those of one eighth of the time are looked at, or all. *)
Definition long_race (z : Z) : scene :=
  let tr z := map (fun k => (Z.of_nat k, V3 (Z.of_nat k) (Z.of_nat k mod 7) z)) (seq 0 1000) in
  touching 0 999 (fun v => tr (if v =? 0 then 0 else z)) 2
        (fun i => [i]) (fun i => i) [].
Definition eighths (tok : token) :=
  [TParts; TOne; THalve; THalve; tok; THalve; tok; tok; THalve; THalve; tok; tok; tok; TOne].
Lemma ok_long : lax (long_race 1) point_first (eighths (TDirection up)) = true. Proof. computed. Qed.
Lemma ok_long_plane : lax (long_race 2) point_first (eighths (above 1)) = true. Proof. computed. Qed.
Lemma no_long : lax (long_race 0) point_first (eighths (TDirection up)) = false. Proof. computed. Qed.
Lemma no_long_plane : lax (long_race 1) point_first (eighths (above 1)) = false. Proof. computed. Qed.

(** Three vertices a side: the lowest of one against the highest of the other. *)
Definition steps (h : Z) : scene :=
  touching 0 4 (fun v => at_rest (V3 v 0 (if v =? h then 5 else v))) 2
        (fun i => if i =? 0 then [0; 1; 2] else [6; 7; 8]) (fun i => i) [].
Lemma ok_steps : lax (steps 9) point_first (close (TDirection up)) = true. Proof. computed. Qed.
Lemma ok_steps_high : lax (steps 1) point_first (close (TDirection up)) = true. Proof. computed. Qed.
Definition raised v : scene :=
  touching 0 4 (fun u => at_rest (V3 u 0 (if u =? v then 6 else u))) 2
        (fun i => if i =? 0 then [0; 1; 2] else [6; 7; 8]) (fun i => i) [].
Lemma no_raised : forallb (fun v => negb (lax (raised v) point_first (close (TDirection up)))) [0; 1; 2] = true.
Proof. computed. Qed.
Definition sunk v : scene :=
  touching 0 4 (fun u => at_rest (V3 u 0 (if u =? v then 2 else u))) 2
        (fun i => if i =? 0 then [0; 1; 2] else [6; 7; 8]) (fun i => i) [].
Lemma no_sunk : forallb (fun v => negb (lax (sunk v) point_first (close (TDirection up)))) [6; 7; 8] = true.
Proof. computed. Qed.

(** ** S: by bounds, by a plane, by walking *)

(** Whether each of the three shows that the first of two cells is further in direction [n], over [a/d, b/d]. *)
Definition ways_over (a b d : Z) (s : scene) (g : group) (n : vec) : list bool :=
  match start s g with
  | Some [Self (Node _ _ x y) o _ _ _] =>
      let e := least s o in
      let k := e * e * dot n n in
      let hw := plane_between k n a b d (verts x) (verts y) in
      [apart_by_bounds (tbeg s) (tend s) k n a b d (verts x) (verts y);
       apart_by_plane e (fst hw) (snd hw) a b d (verts x) (verts y); apart_by_walk k n a b d (verts x) (verts y)]
  | _ => []
  end.
Definition ways_of s := ways_over (tbeg s) (tend s) 1 s.

(** Two points go up by 8, one [z] above the other, to be [e] apart, in units of [m], and begin at the height [m c]. *)
Definition near_at m c z e := spaced 0 4
  (fun v => map (fun b => (fst b, V3 0 0 (m * (c + snd b)))) (if v =? 0 then [(0, 0); (1, 5); (4, 8)]
                                                              else [(0, z); (1, z + 2); (2, z + 1); (4, z + 8)]))
  2 (fun i => [i]) (fun i => i) [] (m * e).
Definition near := near_at 1 0.
(** The lower is up to 3 above its straight line, the upper up to 3 below, and 4 is for what is rounded. *)
Lemma ok_bounds : ways_of (near 11 0) point_first up = [true; true; true]. Proof. computed. Qed.
Lemma no_bounds : ways_of (near 10 0) point_first up = [false; true; true]. Proof. computed. Qed.
Lemma ok_bounds_down : ways_of (near 11 0) tri_first down = [true; true; true]. Proof. computed. Qed.
Lemma no_bounds_down : ways_of (near 10 0) tri_first down = [false; true; true]. Proof. computed. Qed.
Lemma ok_between_plane : ways_of (near 7 0) point_first up = [false; true; true]. Proof. computed. Qed.
Lemma ok_walk : ways_of (near 6 0) point_first up = [false; false; true]. Proof. computed. Qed.
Lemma no_walk : ways_of (near 5 0) point_first up = [false; false; false]. Proof. computed. Qed.
Lemma ok_each_way : forallb (fun z => lax (near z 0) point_first (close (TDirection up))) [6; 8; 11] = true.
Proof. computed. Qed.
Lemma no_way : lax (near 5 0) point_first (close (TDirection up)) = false. Proof. computed. Qed.
Theorem safe_by_bounds : never_touch false (near 11 0).
Proof. apply (check_sound false _ point_first (close (TDirection up))). computed. Qed.

(** At a distance of 2: more than that has to be left. *)
Lemma ok_bounds_wide : ways_of (near 13 2) point_first up = [true; true; true]. Proof. computed. Qed.
Lemma no_bounds_wide : ways_of (near 12 2) point_first up = [false; true; true]. Proof. computed. Qed.
Lemma ok_bounds_wide_long : ways_of (near 13 2) point_first (V3 0 0 3) = [true; true; true]. Proof. computed. Qed.
Lemma no_bounds_wide_long : ways_of (near 12 2) point_first (V3 0 0 3) = [false; true; true]. Proof. computed. Qed.
Lemma no_between_plane_wide : ways_of (near 9 2) point_first up = [false; false; true]. Proof. computed. Qed.
Lemma no_walk_wide : ways_of (near 7 2) point_first up = [false; false; false]. Proof. computed. Qed.

(** Large numbers: units are 2^8 where the largest has 49 bits, on either side of 0. *)
Definition large c z e := near_at 256 c z e.
Definition chord_at s v := chord_of (unit_bits (path s) [0; 1]) (tbeg s) (tend s) (path s v).
Lemma ok_unit : option_map grain (chord_at (large (- 2 ^ 40) 11 0) 0) = Some 256. Proof. computed. Qed.
Lemma ok_bounds_large : map (fun c => ways_of (large c 11 0) point_first up) [2 ^ 40; - 2 ^ 40]
  = [[true; true; true]; [true; true; true]]. Proof. computed. Qed.
Lemma no_bounds_large : map (fun c => ways_of (large c 10 0) point_first up) [2 ^ 40; - 2 ^ 40]
  = [[false; true; true]; [false; true; true]]. Proof. computed. Qed.
Lemma ok_bounds_large_wide : ways_of (large (2 ^ 40) 13 2) point_first up = [true; true; true]. Proof. computed. Qed.
Lemma no_bounds_large_wide : ways_of (large (2 ^ 40) 12 2) point_first up = [false; true; true]. Proof. computed. Qed.

(** Parts of the time: one point comes from far in the first half and passes the other in the second. *)
Definition passing := two_points [(0, V3 0 0 0); (4, V3 0 0 0)] [(0, V3 0 0 400); (4, V3 0 0 (-100))].
Definition part k d := hd false (ways_over (4 * k) (4 * (k + 1)) d passing point_first up).
Lemma ok_part : map (fun k => part k 4) [0; 1; 2; 3] = [true; true; true; false]. Proof. computed. Qed.
Lemma no_all : part 0 1 = false. Proof. computed. Qed.
Lemma ok_part_small : part 201 256 = true. Proof. computed. Qed.
Lemma no_part_small : part 202 256 = false. Proof. computed. Qed.
Lemma no_part_too_small : part 0 512 = false. Proof. computed. Qed.
Lemma no_part_across : hd false (ways_over 2 6 4 passing point_first up) = false. Proof. computed. Qed.

(** Words are modulo 2^63; chords that are too long for them have no band. *)
Lemma ok_word : map (fun z => val (to_word z)) [2 ^ 62 - 1; 2 ^ 62; - 2 ^ 62; - 2 ^ 62 - 1; 2 ^ 63]
  = [2 ^ 62 - 1; - 2 ^ 62; - 2 ^ 62; 2 ^ 62 - 1; 0]. Proof. computed. Qed.
Definition has_band x := if band_of (Chord 1 (V3 x 0 0) (V3 0 x 0) (V3 0 0 0) (V3 0 0 0)) then true else false.
Lemma ok_band : map has_band [2 ^ 41; 2 ^ 41 + 1; - 2 ^ 41; - 2 ^ 41 - 1] = [true; false; true; false].
Proof. computed. Qed.

(** A chord is from the first time to the last. *)
Definition has_chord T0 T1 := if chord_of 0 T0 T1 zigzag then true else false.
Lemma ok_chord : has_chord 0 3 = true. Proof. computed. Qed.
Lemma no_chord : map (fun t => has_chord (fst t) (snd t)) [(1, 3); (0, 2); (-1, 3); (0, 4)] = [false; false; false; false].
Proof. computed. Qed.
Definition early := Scene 1 4 (path (near 11 0)) (fun v => v) 2 (fun i => [i]) (fun i => i) [] 0 1.
Lemma ok_early : ways_of early point_first up = [false; true; true]. Proof. computed. Qed.

(** What strays: axis by axis, down and up, and a unit or two for what is rounded. *)
Lemma ok_strays : chord_of 0 0 4 [(0, V3 1 2 3); (1, V3 9 2 0); (2, V3 5 2 3); (4, V3 5 2 11)]
  = Some (Chord 1 (V3 1 2 3) (V3 4 0 8) (V3 (-2) (-2) (-7)) (V3 9 2 2)). Proof. computed. Qed.

(** Groups of several vertices, in which another than the first is the least: as [raised] and [sunk], by bounds. *)
Definition groups v w : scene :=
  touching 0 4 (fun u => at_rest (V3 u 0 (10 * (if u =? v then 6 else if u =? w then 2 else u)))) 2
        (fun i => if i =? 0 then [0; 1; 2] else [6; 7; 8]) (fun i => i) [].
Lemma ok_groups : hd false (ways_of (groups (-1) (-1)) point_first up) = true. Proof. computed. Qed.
Lemma no_groups : forallb (fun v => negb (hd true (ways_of (groups v (-1)) point_first up))) [0; 1; 2] = true.
Proof. computed. Qed.
Lemma no_groups_second : forallb (fun w => negb (hd true (ways_of (groups (-1) w) point_first up))) [6; 7; 8] = true.
Proof. computed. Qed.

(** ** As it is read: exponents, and the same start *)

Lemma ok_coarse_part : map (fun s => coarse_part s (-13) 3) [0; 2; 3; 4; 9; 99] = [-104; -26; -13; -7; -1; -1].
Proof. computed. Qed.
Lemma ok_part_of_time : map (fun t => Checker.part t 3) [0; 1; 2; 3; -1] = [0; 349525; 699050; 1048576; -349526]. Proof. computed. Qed.

(** The scene's trajectories, with coordinates as multiples of 2^e. *)
Definition reading_of e (s : scene) v :=
  let spot p := Spot (vx p / 2 ^ e) e (vy p / 2 ^ e) e (vz p / 2 ^ e) e in
  match path s v with
  | (t, p) :: r => Reading t (spot p) (Delay (fun _ => map (fun b => (fst b, spot (snd b))) r))
  | [] => Reading 0 (Spot 0 0 0 0 0 0) (Delay (fun _ => []))
  end.
Definition accepts_reading read s toks :=
  match start_read read s point_first with Some st => run false s st toks | None => None end.
Lemma ok_reading : map (fun e => accepts_reading (reading_of e (fall 2)) (fall 2) (close (above 1))) [0; 1] = [Some []; Some []].
Proof. computed. Qed.
Lemma no_reading : map (fun s => accepts_reading (reading_of 0 s) s (close (above 1)))
  [fall 0; over_tri [(0, V3 2 2 8); (4, V3 2 2 8); (1, V3 2 2 8)]; over_tri [(0, V3 2 2 8); (1, V3 2 2 8)];
   over_tri [(1, V3 2 2 8); (4, V3 2 2 8)]] = [None; None; None; None].
Proof. computed. Qed.

(** ** T: halves *)

(** One point passes the other at a corner: a direction serves half of the time. *)
Definition pass k : scene :=
  touching 0 1 (fun v => if v =? 0 then [(0, V3 0 0 0); (1, V3 0 0 0)] else [(0, V3 4 (k - 4) 0); (1, V3 (k - 4) 4 0)])
        2 (fun i => [i]) (fun i => i) [].
Definition east := TDirection (V3 1 0 0).
Definition north := TDirection (V3 0 1 0).
Definition east_of x := plane (V3 2 0 0) 0 x.
Definition north_of y := plane (V3 0 2 0) 0 y.
Definition halves t1 t2 := [TParts; TOne; THalve; t1; t2; TOne].
Lemma ok_halves : lax (pass 2) point_first (halves east north) = true. Proof. computed. Qed.
Lemma ok_halves_planes : lax (pass 2) point_first (halves (east_of 1) (north_of 1)) = true. Proof. computed. Qed.
Lemma ok_halves_self : lax (pass 2) point_first (THalve :: close east ++ close north) = true. Proof. computed. Qed.
Lemma ok_quarters : lax (pass 2) point_first
  [TParts; TOne; THalve; THalve; east; east; THalve; north; north; TOne] = true. Proof. computed. Qed.
Lemma no_halves : lax (pass 2) point_first (close east) = false. Proof. computed. Qed.
Lemma no_halves_zero : lax (pass 0) point_first (halves east north) = false. Proof. computed. Qed.
Lemma no_halves_order : lax (pass 2) point_first (halves north east) = false. Proof. computed. Qed.
Lemma no_halves_plane_zero : lax (pass 2) point_first (halves (east_of 2) (north_of 1)) = false.
Proof. computed. Qed.
Lemma no_halves_plane_zero_second : lax (pass 2) point_first (halves (east_of 1) (north_of 2)) = false.
Proof. computed. Qed.
Lemma no_half_missing : lax (pass 2) point_first [TParts; TOne; THalve; east; TOne] = false. Proof. computed. Qed.
Lemma no_half_missing_at_end : lax (pass 2) point_first (THalve :: close east) = false. Proof. computed. Qed.

Definition halvings n := run false (pass 2) [Self (Leaf 0 []) Disjoint 0 1 1] (repeat THalve n).
Definition pair_halvings n := run false (pass 2) [Pair (Leaf 0 []) (Leaf 0 []) Disjoint 0 1 1] (repeat THalve n).
Lemma ok_depth_pair : (if pair_halvings 1024 then true else false) = true. Proof. computed. Qed.
Lemma no_depth_pair : (if pair_halvings 1025 then true else false) = false. Proof. computed. Qed.
Lemma ok_depth : (if halvings 1024 then true else false) = true. Proof. computed. Qed.
Lemma no_depth : (if halvings 1025 then true else false) = false. Proof. computed. Qed.

(** ** D: two triangles with a common edge *)

Definition hinge : scene :=
  touching 0 4 (fun v => at_rest (match v with 0 => V3 (-4) 0 0 | 1 => V3 0 (-4) 0 | 2 => V3 0 4 0 | _ => V3 4 0 4 end))
        2 (fun i => if i =? 0 then [2; 0; 1] else [1; 3; 2]) (fun i => i) [].
Definition dir x y := TDirection (V3 x y 0).
Definition hinge_with k :=
  [TParts; TOne; TDrop k; TDrop 0; dir (-1) 0; dir (-1) 1; TDrop 0; dir (-1) (-1); dir (-1) 0; TOne].
Lemma ok_drop : lax hinge tri_first (hinge_with 0) = true. Proof. computed. Qed.
(** The common vertices are 1 and 2: number 1 is vertex 2, after which other pairs are left. *)
Lemma no_drop_other : lax hinge tri_first (hinge_with 1) = false. Proof. computed. Qed.
Lemma ok_drop_other : lax hinge tri_first
  [TParts; TOne; TDrop 1; TDrop 0; dir (-1) 0; dir (-1) (-1); TDrop 0; dir (-1) 1; dir (-1) 0; TOne] = true.
Proof. computed. Qed.
Lemma no_drop_beyond : lax hinge tri_first (hinge_with 2) = false. Proof. computed. Qed.
Lemma no_drop_negative : lax hinge tri_first (hinge_with (-1)) = false. Proof. computed. Qed.
Lemma no_drop_nothing_common : lax (fall 2) point_first [TParts; TOne; TDrop 0] = false. Proof. computed. Qed.
Lemma no_drop_needed : lax hinge tri_first (close (dir (-1) 0)) = false. Proof. computed. Qed.

(** The same with a seam: the second triangle has vertices of its own, 11 and 12, at the
    places of 1 and 2, unless [p] says otherwise of 12. *)
Definition seam (f : Z -> Z) (p : traj) : scene :=
  Scene 0 4 (fun v => if v =? 12 then p else path hinge (v mod 10)) f 2
        (fun i => if i =? 0 then [2; 0; 1] else [11; 3; 12]) (fun i => i) [] 0 1.
Definition to_first v := v mod 10.
Definition to_second v := if v <? 3 then v + 10 else v.
Definition to_other v := v mod 10 + 20.
Definition sewn f := lax (seam f (path hinge 2)) tri_first (hinge_with 0).
Lemma ok_same : sewn to_first = true. Proof. computed. Qed.
Lemma ok_same_other : sewn to_other = true. Proof. computed. Qed.
Lemma no_same_none : sewn (fun v => v) = false. Proof. computed. Qed.
Lemma ok_same_second : sewn to_second = true. Proof. computed. Qed.
Lemma no_same_one : sewn (fun v => if v =? 11 then 1 else v) = false. Proof. computed. Qed.
Theorem safe_same : never_touch false (seam to_first (path hinge 2)).
Proof. exact (check_sound _ _ _ _ ok_same). Qed.
(** Vertex 3 follows 2 in order: what is number 0 depends on the ids of those that stand for others. *)
Lemma ok_same_order : lax (seam (fun v => if v =? 1 then 11 else if v =? 12 then 2 else v) (path hinge 2))
  tri_first [TParts; TOne; TDrop 0; TDrop 0; dir (-1) 0; dir (-1) (-1); TDrop 0; dir (-1) 1; dir (-1) 0; TOne] = true.
Proof. computed. Qed.
(** Merged vertices with other trajectories, even if they are at the same places. *)
Definition sewn_to p := lax (seam to_first p) tri_first (hinge_with 0).
Lemma ok_same_equal : sewn_to [(0, V3 0 4 0); (4, V3 0 4 0)] = true. Proof. computed. Qed.
Lemma no_same_unlike : forallb (fun p => negb (sewn_to p))
  [[(0, V3 0 4 0); (4, V3 1 4 0)]; [(0, V3 0 4 0); (4, V3 0 5 0)]; [(0, V3 0 4 0); (4, V3 0 4 1)];
   [(0, V3 0 4 0); (5, V3 0 4 0)]; [(0, V3 0 4 0); (2, V3 0 4 0); (4, V3 0 4 0)]; [(0, V3 0 4 0)]; []] = true.
Proof. computed. Qed.
Lemma no_same_shorter : equal_traj [(0, V3 0 4 0)] [] = false. Proof. computed. Qed.

(** Strict, one edge against itself: its vertices are apart.  A side without a vertex
    is closed by any direction. *)
Definition edge x : scene := touching 0 4 (fun v => at_rest (V3 (v * x) 0 0)) 1 (fun _ => [0; 1]) (fun _ => 7) [].
Definition nothing := TDirection (V3 0 0 0).
Definition edge_self := [TBoth; TDrop 0; TDrop 0; nothing; dir 1 0; TDrop 0; dir (-1) 0; nothing].
Lemma ok_strict : check true (edge 2) #0 edge_self = true. Proof. computed. Qed.
Lemma ok_strict_planes : check true (edge 2) #0
  (let p x nd := plane (V3 x 0 0) 0 nd in
   [TBoth; TDrop 0; TDrop 0; p 0 1; p 1 1; TDrop 0; p (-1) (-1); p 0 (-1)]) = true. Proof. computed. Qed.
Lemma no_strict : check true (edge 0) #0 edge_self = false. Proof. computed. Qed.
Lemma no_strict_one : check true (edge 2) #0 [TOne] = false. Proof. computed. Qed.
Lemma ok_lax_one : lax (edge 0) #0 [TOne] = true. Proof. computed. Qed.

(** ** L, R, N, B: groups *)

(** Three points in a row, one in each cell. *)
Definition row : scene := touching 0 4 (fun v => at_rest (V3 v 0 0)) 3 (fun i => [i]) (fun i => i) [].
Definition row_left := ((#0 + #1) + #2)%group.
Definition row_right := (#0 + (#1 + #2))%group.
Lemma ok_left : lax row row_left
  [TParts; TParts; TOne; dir (-1) 0; TOne; TLeft; dir (-1) 0; dir (-1) 0; TOne] = true. Proof. computed. Qed.
Lemma ok_right : lax row row_right
  [TParts; TOne; TRight; dir (-1) 0; dir (-1) 0; TParts; TOne; dir (-1) 0; TOne] = true. Proof. computed. Qed.
Lemma ok_group : lax row row_left
  [TParts; TParts; TOne; dir (-1) 0; TOne; dir (-1) 0; TOne] = true. Proof. computed. Qed.
Lemma ok_both : lax row row_left
  [TParts; TBoth; TLeft; TRight; TDrop 0; nothing; nothing; dir (-1) 0;
   TRight; dir 1 0; TDrop 0; nothing; nothing; dir (-1) 0; TOne] = true. Proof. computed. Qed.
Lemma no_left_leaf : lax row row_right [TParts; TOne; TLeft] = false. Proof. computed. Qed.
Lemma no_right_leaf : lax row row_left [TParts; TParts; TOne; dir (-1) 0; TOne; TRight] = false.
Proof. computed. Qed.
Lemma no_parts_leaf : lax row row_right [TParts; TParts] = false. Proof. computed. Qed.
Lemma no_one_node : lax row row_right [TOne] = false. Proof. computed. Qed.
Lemma no_drop_node : lax row row_right [TParts; TOne; TDrop 0] = false. Proof. computed. Qed.

(** A token of the other kind of obligation. *)
Definition root := Leaf 0 [bare 0 (at_rest (V3 0 0 0))].
Definition on_pair := step false row [Pair (Node None [] root root) (Node None [] root root) Distance 0 4 1].
Definition on_self := step false row [Self (Node None [] root root) Distance 0 4 1].
Definition refused (o : option (list obligation)) := match o with None => true | Some _ => false end.
Lemma no_token_on_pair : forallb (fun tok => refused (on_pair tok)) [TParts; TOne; TBoth; TDrop 0; TRing 0 [[]]] = true.
Proof. computed. Qed.
Lemma no_token_on_self :
  forallb (fun tok => refused (on_self tok))
  [TLeft; TRight; TDrop 0; TRing 0 [[]]; TFar; above 0; TDirection up] = true.
Proof. computed. Qed.

(** The stack: tokens after the last obligation, and obligations after the last token. *)
Lemma no_more_tokens : forallb (fun tok => negb (lax (fall 2) point_first (close (above 1) ++ [tok])))
  [THalve; TLeft; TRight; TDrop 0; TRing 0 [[]]; TFar; above 1; TDirection up; TExcluded; TParts; TOne; TBoth] = true.
Proof. computed. Qed.
Lemma no_tokens : lax (fall 2) point_first [] = false. Proof. computed. Qed.
Lemma no_token_less : lax (fall 2) point_first [TParts; TOne; above 1] = false. Proof. computed. Qed.

(** ** X: labels *)

(** Four points at one place, in cells of their own with these labels. *)
Definition heap (l : list Z) (e : list (Z * Z)) : scene :=
  touching 0 4 (fun _ => at_rest (V3 0 0 0)) 4 (fun i => [i]) (fun i => nth (Z.to_nat i) l 0) e.
Definition two_two := ((#0 + #1) + (#2 + #3))%group.
Lemma ok_excluded_self : lax (heap [5; 5; 5; 5] [(5, 5)]) two_two [TExcluded] = true. Proof. computed. Qed.
Lemma ok_excluded_pair : lax (heap [5; 5; 6; 6] [(5, 5); (6, 5); (6, 6)]) two_two
  [TParts; TExcluded; TExcluded; TExcluded] = true. Proof. computed. Qed.
Lemma ok_excluded_swapped : lax (heap [5; 5; 6; 6] [(5, 5); (5, 6); (6, 6)]) two_two
  [TParts; TExcluded; TExcluded; TExcluded] = true. Proof. computed. Qed.
Lemma no_excluded_pair : lax (heap [5; 5; 6; 6] [(5, 5); (6, 6); (5, 7); (7, 6)]) two_two
  [TParts; TExcluded; TExcluded; TExcluded] = false. Proof. computed. Qed.
Lemma no_excluded_self : lax (heap [5; 5; 5; 5] [(5, 6); (6, 6)]) two_two [TExcluded] = false.
Proof. computed. Qed.
Lemma no_excluded_mixed_self : lax (heap [5; 5; 6; 6] [(5, 5); (5, 6); (6, 6)]) two_two [TExcluded] = false.
Proof. computed. Qed.
Lemma no_excluded_mixed_first : lax (heap [5; 7; 6; 6] [(5, 5); (5, 6); (6, 6); (5, 7); (7, 7); (7, 6)]) two_two
  [TParts; TParts; TExcluded; TExcluded; TExcluded; TExcluded] = false. Proof. computed. Qed.
Lemma no_excluded_mixed_second : lax (heap [6; 6; 5; 7] [(5, 5); (5, 6); (6, 6); (5, 7); (7, 7); (7, 6)]) two_two
  [TParts; TExcluded; TExcluded] = false. Proof. computed. Qed.
Lemma no_excluded : lax (heap [5; 5; 5; 5] []) two_two [TExcluded] = false. Proof. computed. Qed.

(** ** The tree has each cell once *)

Definition row_tokens := [TParts; TParts; TOne; dir (-1) 0; TOne; dir (-1) 0; TOne].
Definition row_with g := lax row g row_tokens.
Lemma ok_tree : row_with row_left = true. Proof. computed. Qed.
Definition two i j := (#i + #j)%group.
Lemma no_cell_missing :
  forallb (fun i => negb (lax row (two i ((i + 1) mod 3)) (close (dir (-1) 0)))) [0; 1; 2] = true.
Proof. computed. Qed.
Lemma no_tree_of_one : lax row #0 [TOne] = false. Proof. computed. Qed.
Lemma no_cell_twice : start row (row_left + #1)%group = None. Proof. computed. Qed.
Lemma no_cell_twice_instead : start row ((#0 + #2) + #2)%group = None. Proof. computed. Qed.
Lemma no_cell_beyond : start row (row_left + #3)%group = None. Proof. computed. Qed.
Lemma no_cell_twice_at_end : start row ((#0 + #1) + #1)%group = None. Proof. computed. Qed.
Lemma no_cell_beyond_instead : start row ((#0 + #1) + #3)%group = None. Proof. computed. Qed.
Lemma no_cell_negative : start row (Join (Cell (-1)) row_left) = None. Proof. computed. Qed.
Lemma no_cell_negative_instead : start row (Join (Cell (-1)) (two 1 2)) = None. Proof. computed. Qed.

(** A vertex that is not in the table of vertices is not found. *)
Definition table ids := join_all ids (vertices (vertex_of row 0) ids []).
Lemma ok_look_up : match table [1; 4; 5; 8; 9] with
  | Some x => map (fun v => match look_up x v with Some w => vid w | None => -1 end) [0; 1; 2; 4; 5; 7; 8; 9; 10]
  | None => []
  end = [-1; 1; -1; 4; 5; -1; 8; 9; -1].
Proof. computed. Qed.
Lemma no_look_up : match table [1; 4] with Some x => look_up_all x [1; 2] | None => Some [] end = None.
Proof. computed. Qed.
Lemma no_table : table [] = None. Proof. computed. Qed.

(** ** Scenes that make no sense *)

(** One cell, which needs no proof if the scene is as it should be. *)
Definition alone t0 t1 tr := lax (touching t0 t1 (fun _ => tr) 1 (fun _ => [0; 1]) (fun _ => 0) []) #0 [TOne].
Definition o := V3 0 0 0.
Lemma ok_alone : alone 0 4 [(0, o); (4, o)] = true. Proof. computed. Qed.
Lemma ok_longer : alone 0 4 [(-2, o); (-1, o); (2, o); (5, o); (6, o)] = true. Proof. computed. Qed.
Lemma no_begin : alone 0 4 [(1, o); (4, o)] = false. Proof. computed. Qed.
Lemma no_end : alone 0 4 [(0, o); (3, o)] = false. Proof. computed. Qed.
Lemma no_breakpoint : alone 0 4 [] = false. Proof. computed. Qed.
Lemma no_time_equal : alone 0 4 [(0, o); (2, o); (2, o); (4, o)] = false. Proof. computed. Qed.
Lemma no_time_back : alone 0 4 [(0, o); (3, o); (2, o); (4, o)] = false. Proof. computed. Qed.
Lemma no_time_back_after : alone 0 4 [(0, o); (5, o); (4, o)] = false. Proof. computed. Qed.
Lemma no_interval : alone 4 4 [(0, o); (4, o); (6, o)] = false. Proof. computed. Qed.
Lemma no_interval_back : alone 4 0 [(0, o); (4, o)] = false. Proof. computed. Qed.
Definition many n := touching 0 4 (fun _ => at_rest o) n (fun _ => [0]) (fun _ => 0) [].
Lemma no_cells : forallb (fun n => negb (lax (many n) #0 [TOne])) [0; -1; 2] = true. Proof. computed. Qed.

(** ** Witnesses of contact *)

(** The time c/d, with weights that do not change. *)
Definition constant (l : list (Z * Z)) := map (fun x => (fst x, [snd x])) l.
Definition at_time c d i j p q := Witness i j (constant p) (constant q) [- c; d] c c d.

(** The point is at height 8 - (10/3)(t-1), which is 0 at t = 17/5. *)
Definition hit := at_time 17 5 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)].
Lemma ok_hit : check_hit false (fall (-2)) hit = true. Proof. computed. Qed.
Theorem unsafe : forall strict, ~ never_touch strict (fall (-2)).
Proof. exact (check_hit_sound_both _ _ ok_hit). Qed.
Lemma ok_hit_swapped : check_hit false (fall (-2)) (at_time 34 10 0 1 [(2, 3); (0, 6); (1, 3)] [(3, 5)]) = true.
Proof. computed. Qed.
Lemma ok_hit_end : check_hit false (fall 0) (at_time 4 1 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]) = true.
Proof. computed. Qed.
Lemma ok_hit_begin : check_hit false (over_tri [(0, V3 2 2 0); (4, V3 2 2 8)])
  (at_time 0 9 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]) = true. Proof. computed. Qed.
Lemma ok_hit_strict : check_hit true (edge 0) (at_time 1 1 0 0 [(0, 1)] [(1, 1)]) = true. Proof. computed. Qed.

Definition no_hit w := check_hit false (fall (-2)) w = false.
Lemma no_hit_time : no_hit (at_time 18 5 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_place : no_hit (at_time 17 5 1 0 [(3, 1)] [(0, 1); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_place_y : no_hit (at_time 17 5 1 0 [(3, 1)] [(0, 3); (1, 1)]). Proof. computed. Qed.
Lemma no_hit_place_x : no_hit (at_time 17 5 1 0 [(3, 1)] [(0, 3); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_denominator : no_hit (at_time (-17) (-5) 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_denominator_0 : no_hit (at_time 0 0 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_weight : no_hit (at_time 17 5 1 0 [(3, 2); (3, -1)] [(0, 2); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_total : no_hit (at_time 17 5 1 0 [(3, 0)] [(0, 0); (1, 0); (2, 0)]). Proof. computed. Qed.
Lemma no_hit_nothing : no_hit (at_time 17 5 1 0 [] []). Proof. computed. Qed.
Lemma no_hit_vertex : no_hit (at_time 17 5 0 1 [(3, 1)] [(0, 2); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_cell : no_hit (at_time 17 5 2 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_cell_negative : no_hit (at_time 17 5 (-1) 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]). Proof. computed. Qed.
Lemma no_hit_denominator_0_end : check_hit false (fall 0) (at_time 0 0 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]) = false.
Proof. computed. Qed.
Lemma no_hit_common : check_hit false hinge (at_time 0 1 0 1 [(1, 1)] [(1, 1)]) = false. Proof. computed. Qed.
Definition hit_seam f := check_hit false (seam f (path hinge 2)) (at_time 0 1 0 1 [(1, 1)] [(11, 1)]).
Lemma ok_hit_seam : hit_seam (fun v => v) = true. Proof. computed. Qed.
Lemma no_hit_seam : hit_seam to_first = false. Proof. computed. Qed.
Lemma no_hit_seam_other : hit_seam to_other = false. Proof. computed. Qed.
Lemma no_hit_one_cell : check_hit false (edge 0) (at_time 1 1 0 0 [(0, 1)] [(1, 1)]) = false. Proof. computed. Qed.

(** The same contact in claims that are about less. *)
Definition fall_claim t0 t1 e :=
  let s := fall (-2) in touching t0 t1 (path s) (ncell s) (cell s) (label s) e.
Lemma ok_hit_claim : check_hit false (fall_claim 0 4 [(0, 0); (1, 1)]) hit = true. Proof. computed. Qed.
Lemma no_hit_excluded : check_hit false (fall_claim 0 4 [(0, 1)]) hit = false. Proof. computed. Qed.
Lemma no_hit_excluded_swapped : check_hit false (fall_claim 0 4 [(1, 0)]) hit = false. Proof. computed. Qed.
Lemma no_hit_after : check_hit false (fall_claim 0 3 []) hit = false. Proof. computed. Qed.
Lemma no_hit_before : check_hit false
  (let s := over_tri [(0, V3 2 2 0); (4, V3 2 2 8)] in touching 1 4 (path s) 2 (cell s) (label s) [])
  (at_time 0 1 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]) = false. Proof. computed. Qed.
Lemma no_hit_interval : check_hit false
  (let s := fall 0 in touching 4 4 (path s) 2 (cell s) (label s) [])
  (at_time 4 1 1 0 [(3, 1)] [(0, 2); (1, 1); (2, 1)]) = false. Proof. computed. Qed.
Lemma no_hit_trajectory : check_hit false (fall_claim 0 5 []) hit = false. Proof. computed. Qed.

(** *** Times that are roots *)

(** An edge from (0, 0, 0) to (2, t, 0) that turns, and a point at (t, 1, 0): in it at the root of 2.
    [mid] are the breakpoints of the point between the first and last. *)
Definition turning mid := touching 0 4
  (fun v => match v with 0 => at_rest o | 1 => [(0, V3 2 0 0); (4, V3 2 4 0)]
                       | _ => (0, V3 0 1 0) :: mid ++ [(4, V3 4 1 0)] end)
  2 (fun i => if i =? 0 then [0; 1] else [2]) (fun i => i) [].
Definition ends := [(0, [2; -1]); (1, [0; 1])].
Definition at_root p q g l u d := check_hit false (turning []) (Witness 0 1 p q g l u d).
Definition root_2 := [-2; 0; 1].
Definition inside_edge := [(2, [1])].
Lemma ok_root : at_root ends inside_edge root_2 1 2 1 = true. Proof. computed. Qed.
Theorem unsafe_root : forall strict, ~ never_touch strict (turning []).
Proof. exact (check_hit_sound_both _ _ ok_root). Qed.
Lemma ok_root_closer : at_root ends inside_edge root_2 181 182 128 = true. Proof. computed. Qed.
Lemma ok_root_negative : at_root ends inside_edge [2; 0; -1] 1 2 1 = true. Proof. computed. Qed.
(** A multiple may have the same sign at both ends, and does not divide what is 0. *)
Lemma no_root_multiple : at_root ends inside_edge (mul root_2 [-3; 2]) 1 2 1 = false. Proof. computed. Qed.
Lemma no_root_not_divided : at_root ends inside_edge (mul root_2 [1; 1]) 1 2 1 = false. Proof. computed. Qed.
Lemma no_root_other : at_root ends inside_edge [-3; 0; 1] 1 2 1 = false. Proof. computed. Qed.
(** The interval has no root of it, or not for certain. *)
Lemma no_root_before : at_root ends inside_edge root_2 0 1 1 = false. Proof. computed. Qed.
Lemma no_root_after : at_root ends inside_edge root_2 3 4 2 = false. Proof. computed. Qed.
Lemma no_root_two : at_root ends inside_edge root_2 (-2) 2 1 = false. Proof. computed. Qed.
Lemma no_root_back : at_root ends inside_edge root_2 2 1 1 = false. Proof. computed. Qed.
Lemma no_root_denominator : at_root ends inside_edge root_2 (-1) (-2) (-1) = false. Proof. computed. Qed.
Lemma no_root_late : check_hit false (let s := turning [] in touching 2 4 (path s) 2 (cell s) (label s) [])
  (Witness 0 1 ends inside_edge root_2 1 2 1) = false. Proof. computed. Qed.
Lemma no_root_early : check_hit false (let s := turning [] in touching 0 1 (path s) 2 (cell s) (label s) [])
  (Witness 0 1 ends inside_edge root_2 1 2 1) = false. Proof. computed. Qed.
(** The polynomial is to have a leading coefficient. *)
Lemma no_root_leading : forallb (fun g => negb (at_root ends inside_edge g 1 2 1))
  [[-2; 0; 1; 0]; [0]; []; [0; 0; 0]] = true.
Proof. computed. Qed.
(** A constant divides all, but has no root. *)
Lemma no_root_constant : at_root ends inside_edge [1] 1 2 1 = false. Proof. computed. Qed.
(** Weights: those divided by the polynomial do not count at the root, whatever their sign. *)
Lemma ok_root_divided : at_root ((0, root_2) :: ends) inside_edge root_2 1 2 1 = true. Proof. computed. Qed.
Lemma ok_root_divided_other : at_root ends [(2, [2; 0; 1]); (2, [2; 0; -1])] root_2 1 2 1 = true.
Proof. computed. Qed.
Lemma no_root_weight_negative : at_root [(0, [2; -1]); (1, [0; 2]); (1, [0; -1])] inside_edge root_2 1 2 1 = false.
Proof. computed. Qed.
Lemma no_root_weight_negative_other : at_root ends [(2, [2]); (2, [-1])] root_2 1 2 1 = false.
Proof. computed. Qed.
Lemma no_root_all_negative : at_root [(0, [-2; 1]); (1, [0; -1])] inside_edge root_2 1 2 1 = false.
Proof. computed. Qed.
Lemma no_root_total : at_root ((0, root_2) :: ends) [(2, root_2)] root_2 1 2 1 = false. Proof. computed. Qed.
(** A weight that is positive at the root has to be so in the interval. *)
Definition narrow := [(0, [2; -1]); (1, [6; -4]); (1, [-6; 5])].
Lemma no_root_narrow : at_root narrow inside_edge root_2 1 2 1 = false. Proof. computed. Qed.
Lemma ok_root_narrow : at_root narrow inside_edge root_2 5 6 4 = true. Proof. computed. Qed.
(** All of the interval is in one segment. *)
Definition bent mid l u := check_hit false (turning mid) (Witness 0 1 ends inside_edge root_2 l u 2).
Lemma ok_root_segment : bent [(1, V3 1 1 0); (2, V3 2 1 0)] 2 4 = true. Proof. computed. Qed.
Lemma no_root_across_1 : bent [(1, V3 1 1 0); (2, V3 2 1 0)] 1 4 = false. Proof. computed. Qed.
Lemma no_root_across_2 : bent [(1, V3 1 1 0); (2, V3 2 1 0)] 2 5 = false. Proof. computed. Qed.
Lemma no_root_elsewhere : bent [(1, V3 1 1 0); (2, V3 2 1 1)] 2 4 = false. Proof. computed. Qed.
(** What is refused at rational times is refused here too. *)
Lemma no_root_vertex : at_root inside_edge ends root_2 1 2 1 = false. Proof. computed. Qed.
Lemma no_root_excluded : check_hit false (let s := turning [] in touching 0 4 (path s) 2 (cell s) (label s) [(1, 0)])
  (Witness 0 1 ends inside_edge root_2 1 2 1) = false. Proof. computed. Qed.
Definition one_face := let s := turning [] in touching 0 4 (path s) 1 (fun _ => [0; 1; 2]) (fun _ => 0) [].
Lemma ok_root_strict : check_hit true one_face (Witness 0 0 ends inside_edge root_2 1 2 1) = true.
Proof. computed. Qed.
Lemma no_root_lax : check_hit false one_face (Witness 0 0 ends inside_edge root_2 1 2 1) = false.
Proof. computed. Qed.
Lemma no_root_shared : check_hit true one_face (Witness 0 0 ((2, root_2) :: ends) inside_edge root_2 1 2 1) = false.
Proof. computed. Qed.

(** The time 17/5, between 27/8 and 28/8. *)
Definition hit_between g l u := check_hit false (fall (-2))
  (Witness 1 0 (constant [(3, 1)]) (constant [(0, 2); (1, 1); (2, 1)]) g l u 8).
Lemma ok_hit_between : hit_between [-17; 5] 27 28 = true. Proof. computed. Qed.
Lemma no_hit_between : hit_between [-17; 5] 25 26 = false. Proof. computed. Qed.
Lemma no_hit_between_other : hit_between [-16; 5] 24 28 = false. Proof. computed. Qed.
(** The first root may be the time 0, at which the polynomial is its variable. *)
Lemma ok_hit_at_0 : check_hit false (over_tri [(0, V3 2 2 0); (4, V3 2 2 8)])
  (Witness 1 0 (constant [(3, 1)]) (constant [(0, 2); (1, 1); (2, 1)]) [0; 1] 0 1 1) = true. Proof. computed. Qed.

(** Polynomials: Bernstein's coefficients, which do not depend on leading zeros, and divisibility. *)
Lemma ok_bernstein : bernstein 1 2 1 [-2; 0; 1] = [-1; 0; 2] /\ bernstein 1 3 2 [0; 0; 0; 1; 0] = [1; 9; 27; 27] /\
  bernstein 1 3 2 [0; 0] = [] /\ bernstein 1 3 2 [7] = [7]. Proof. repeat split. Qed.
Lemma ok_positive : positive_on 1 2 1 [1; -2; 2] = true. Proof. computed. Qed.
Lemma no_positive : forallb (fun p => negb (positive_on 1 2 1 p)) [[]; [0]; [0; 0]; [-1]; [-1; 1]; [2; -1]] = true.
Proof. computed. Qed.
Lemma ok_nonnegative : forallb (nonnegative_on 1 2 1) [[]; [0]; [0; 0]; [1]; [-1; 1]; [2; -1]] = true.
Proof. computed. Qed.
Lemma no_nonnegative : forallb (fun p => negb (nonnegative_on 1 2 1 p)) [[-1]; [-2; 1]; [1; -1]; [9; -12; 4]] = true.
Proof. computed. Qed.
Lemma ok_divides : forallb (divides [6; 0; 4])
  [[]; [0]; [3; 0; 2]; [0; 3; 0; 2]; [3; 9; 2; 6; 0]; [-9; 0; 0; 0; 4]] = true.
Proof. computed. Qed.
Lemma no_divides : forallb (fun p => negb (divides [6; 0; 4] p))
  [[1]; [0; 1]; [3; 1; 2]; [3; 0; -2]; [3; 9; 2; 5]] = true.
Proof. computed. Qed.

(** ** Least distance *)

(** Two points, always apart by (3, 4, 0) and (6, 8, 0): at distance 5 first, then 10. *)
Definition apart e :=
  spaced 0 1 (fun v => if v =? 0 then [(0, V3 0 0 0); (1, V3 0 0 0)] else [(0, V3 3 4 0); (1, V3 6 8 0)])
        2 (fun i => [i]) (fun i => i) [] e.
Definition along_34 := TDirection (V3 3 4 0).
Definition gap nd w := TPlane (HalfSpace (V3 3 4 0) 0 nd) w.
Lemma ok_eta : lax (apart 4) point_first (close along_34) = true. Proof. computed. Qed.
Lemma ok_eta_plane : lax (apart 4) point_first (close (gap 21 20)) = true. Proof. computed. Qed.
Lemma ok_eta_wider : lax (apart 4) point_first (close (gap 24 23)) = true. Proof. computed. Qed.
Theorem safe_eta : never_touch false (apart 4).
Proof. exact (check_sound _ _ _ _ ok_eta). Qed.
Lemma no_eta : lax (apart 5) point_first (close along_34) = false. Proof. computed. Qed.
Lemma no_eta_other : lax (apart 4) point_first (close north) = false. Proof. computed. Qed.
Lemma ok_eta_other : lax (apart 3) point_first (close north) = true. Proof. computed. Qed.
Lemma no_eta_gap : lax (apart 4) point_first (close (gap 21 19)) = false. Proof. computed. Qed.
Lemma no_eta_gap_negative : lax (apart 4) point_first (close (gap 21 (-20))) = false. Proof. computed. Qed.
Lemma no_gap_negative : lax (apart 0) point_first (close (gap 21 (-20))) = false. Proof. computed. Qed.
Lemma no_eta_first : lax (apart 4) point_first (close (gap 25 20)) = false. Proof. computed. Qed.
Lemma no_eta_second : lax (apart 4) point_first (close (gap 20 20)) = false. Proof. computed. Qed.
Lemma no_eta_negative : lax (apart (-1)) point_first (close along_34) = false. Proof. computed. Qed.

(** Values with different denominators, at height 1 or more above each other. *)
Definition cross_eta e := let s := cross 4 in spaced 0 4 (path s) 2 (cell s) (label s) [] e.
Lemma ok_eta_cross : lax (cross_eta 0) point_first (close (TDirection up)) = true. Proof. computed. Qed.
Lemma no_eta_cross : lax (cross_eta 1) point_first (close (TDirection up)) = false. Proof. computed. Qed.
Definition cross_eta_3 e := let s := cross 9 in
  spaced 0 2 (path s) 2 (cell s) (label s) [] e.
Lemma ok_eta_cross_3 : lax (cross_eta_3 5) point_first (close (TDirection up)) = true. Proof. computed. Qed.
Lemma no_eta_cross_3 : lax (cross_eta_3 6) point_first (close (TDirection up)) = false. Proof. computed. Qed.

(** ** W, G: neighbours may be nearer *)

(** A chain of three edges in a row, each of length 3: cell i joins the vertices i and i+1. *)
Definition links e k :=
  Scene 0 4 (fun v => at_rest (V3 (3 * v) 0 0)) (fun v => v) 3 (fun i => [i; i + 1]) (fun i => i) [] e k.
Definition west := dir (-1) 0.
Definition links_with next far :=
  [TParts; TParts; TOne] ++ next 0 ++ [TOne; TLeft] ++ far ++ next 1 ++ [TOne].
(** Of neighbouring cells, the vertices i and i+2 are at distance 6; of the two others, 0 and 2, and 1 and 3. *)
Definition next i :=
  [TDrop 0; TRing i [[(i, i + 1)]]; nothing; west; west; TRing (i + 1) [[(i + 1, i + 2)]]; west; nothing; west].
Definition other := [TRing 1 [[(1, 2)]]; west; west; west].
Definition linked e k := lax (links e k) row_left (links_with next other).
Lemma ok_ring : linked 5 2 = true. Proof. computed. Qed.
Theorem safe_ring : never_touch false (links 5 2).
Proof. exact (check_sound _ _ _ _ ok_ring). Qed.
Lemma ok_ring_more : linked 5 3 = true. Proof. computed. Qed.
Lemma no_ring_eta : linked 6 2 = false. Proof. computed. Qed.
Lemma no_ring_eta_0 : linked 0 2 = false. Proof. computed. Qed.
Lemma no_ring_1 : linked 5 1 = false. Proof. computed. Qed.
Lemma no_ring_0 : start (links 5 0) row_left = None. Proof. computed. Qed.
Lemma no_ring_negative : start (links 0 (-1)) row_left = None. Proof. computed. Qed.
(** A way of no steps does what D does. *)
Definition next_by_none i :=
  [TRing (i + 1) [[]]; TRing i [[(i, i + 1)]]; nothing; west; west; TRing (i + 1) [[(i + 1, i + 2)]]; west; nothing;
   west; TDrop 0; west; west].
Lemma ok_ring_none : lax (links 5 2) row_left (links_with next_by_none other) = true. Proof. computed. Qed.
(** Ways of two steps: nothing of neighbouring cells is far, and of the others only 0 and 3.  What is
    disjoint is shown once, after G. *)
Definition next_two i :=
  [TFar; TRing i [[(i, i + 1); (i + 1, i + 2)]];
   TRing (i + 1) [[]]; nothing; TRing (i + 1) [[(i + 1, i + 2)]]; nothing; nothing;
   TRing (i + 1) [[]]; TRing i [[(i, i + 1)]]; nothing; nothing; nothing; TDrop 0; west; west].
Definition other_two :=
  [TFar; TRing 1 [[(1, 2)]]; TRing 0 [[(0, 1); (1, 2)]]; nothing; west; TRing 1 [[(1, 2); (2, 3)]]; west;
   nothing; west].
Definition linked_two e k := lax (links e k) row_left (links_with next_two other_two).
Lemma ok_ring_two : linked_two 8 3 = true. Proof. computed. Qed.
Lemma no_ring_two_eta : linked_two 9 3 = false. Proof. computed. Qed.
Lemma no_ring_two_eta_0 : linked_two 0 3 = false. Proof. computed. Qed.
Lemma no_ring_two : linked_two 8 2 = false. Proof. computed. Qed.
(** Several ways from one vertex at once. *)
Definition next_ways i :=
  [TFar; TRing i [[(i, i + 1)]; [(i, i + 1); (i + 1, i + 2)]];
   TRing (i + 1) [[]; [(i + 1, i + 2)]]; nothing; nothing; nothing; TDrop 0; west; west].
Lemma ok_ways : lax (links 8 3) row_left (links_with next_ways other_two) = true. Proof. computed. Qed.
Lemma no_ways_too_long : lax (links 5 2) row_left (links_with next_ways other) = false. Proof. computed. Qed.
Lemma no_ways_eta : lax (links 9 3) row_left (links_with next_ways other_two) = false. Proof. computed. Qed.
(** However near neighbours may be, they are to be disjoint. *)
Definition folded k :=
  let s := links 5 k in
  Scene 0 4 (fun v => if v =? 3 then at_rest (V3 3 0 0) else path s v) (same s) 3 (cell s) (label s) [] 5 k.
Lemma no_ring_folded : forallb (fun t => negb (lax (folded 4) row_left t))
  [links_with next other; links_with next_two other_two] = true. Proof. computed. Qed.

(** Each condition of W alone. *)
Definition by_way k v w := lax (links 5 k) row_left (links_with next [TRing v [w]; west; west; west]).
Lemma ok_way : by_way 2 1 [(1, 2)] = true. Proof. computed. Qed.
Lemma ok_way_longer : by_way 3 1 [(0, 1); (1, 2)] = true. Proof. computed. Qed.
Lemma ok_way_back : by_way 4 1 [(0, 0); (0, 1); (1, 2)] = true. Proof. computed. Qed.
Lemma no_way_too_long : by_way 2 1 [(0, 1); (1, 2)] = false. Proof. computed. Qed.
Lemma no_way_cell : by_way 2 1 [(0, 2)] = false. Proof. computed. Qed.
Lemma no_way_cell_other : by_way 2 1 [(2, 2)] = false. Proof. computed. Qed.
(** What is beyond the last cell, or before the first, is none, whatever vertices it may have. *)
Lemma no_way_cell_beyond : way_end (links 5 9) 5 1 [(1, 2); (2, 3); (3, 4)] = None. Proof. computed. Qed.
Lemma no_way_cell_negative : way_end (links 5 9) 5 1 [(0, 0); (-1, -1)] = None. Proof. computed. Qed.
Definition on_cells o tok := step false (links 5 9)
  [Pair (Leaf 0 [bare 0 []; bare 1 []]) (Leaf 2 [bare 2 []; bare 3 []]) o 0 4 1] tok.
Definition left_over (o : option (list obligation)) := match o with None => -1 | Some l => Z.of_nat (length l) end.
Lemma ok_modes : map (fun o => (left_over (on_cells o (TRing 1 [[(1, 2)]])), left_over (on_cells o TFar)))
  [Distance; Far; Disjoint] = [(3, 2); (2, -1); (-1, -1)]. Proof. computed. Qed.
Lemma no_way_begin : on_cells Far (TRing 2 [[]]) = None. Proof. computed. Qed.
Lemma no_way_end : on_cells Far (TRing 1 [[]]) = None. Proof. computed. Qed.
Lemma ok_way_ends : on_cells Far (TRing 1 [[(1, 2)]; [(1, 2); (2, 3)]]) = Some
  [Pair (Leaf 0 [bare 0 []]) (Leaf 2 [bare 2 []; bare 3 []]) Far 0 4 1;
   Pair (Leaf 0 [bare 0 []; bare 1 []]) (Leaf 2 []) Far 0 4 1]. Proof. computed. Qed.
Lemma no_way_end_among : on_cells Far (TRing 1 [[(1, 2)]; [(0, 0)]]) = None. Proof. computed. Qed.
Lemma no_way_among : on_cells Far (TRing 1 [[(1, 2)]; [(1, 2); (1, 3)]]) = None. Proof. computed. Qed.
Lemma ok_way_no_end : left_over (on_cells Far (TRing 1 [])) = 2. Proof. computed. Qed.
Lemma no_way_leaf : forallb (fun o => refused (step false (links 5 9) [o] (TRing 0 [[]])))
  [Pair (Node None [] root root) root Distance 0 4 1; Pair root (Node None [] root root) Distance 0 4 1] = true.
Proof. computed. Qed.
(** A way leads through merged vertices: 1 and 11, 2 and 12 at the seam are one each. *)
Definition by_seam f w := step false (let s := seam f (path hinge 2) in
    Scene 0 4 (path s) (same s) 2 (cell s) (label s) [] 5 3)
  [Pair (Leaf 0 [bare 0 []; bare 1 []]) (Leaf 1 [bare 3 []]) Far 0 4 1] (TRing 0 [w]).
Lemma ok_way_same : left_over (by_seam to_first [(0, 1); (1, 3)]) = 2. Proof. computed. Qed.
Lemma no_way_same : by_seam (fun v => v) [(0, 1); (1, 3)] = None. Proof. computed. Qed.
Lemma no_way_same_other : by_seam to_first [(0, 11); (1, 3)] = None. Proof. computed. Qed.

(** ** Witnesses of a distance *)

Definition hit_eta c e := check_hit false (apart e) (at_time c 5 0 1 [(0, 1)] [(1, 1)]).
Lemma ok_hit_eta : hit_eta 0 5 = true. Proof. computed. Qed.
Lemma ok_hit_eta_later : hit_eta 1 6 = true. Proof. computed. Qed.
Lemma no_hit_eta : hit_eta 0 4 = false. Proof. computed. Qed.
Lemma no_hit_eta_later : hit_eta 1 5 = false. Proof. computed. Qed.

(** The same with segments of different length, and so different denominators. *)
Definition apart_longer e :=
  let s := apart e in
  spaced 0 1 (fun v => if v =? 0 then [(0, V3 0 0 0); (2, V3 0 0 0)] else path s v) 2 (cell s) (label s) [] e.
Definition hit_longer e := check_hit false (apart_longer e) (at_time 1 5 0 1 [(0, 1)] [(1, 1)]).
Lemma ok_hit_longer : hit_longer 6 = true. Proof. computed. Qed.
Lemma no_hit_longer : hit_longer 5 = false. Proof. computed. Qed.
Lemma no_value_after : segment_of 4 4 1 zigzag = None. Proof. computed. Qed.
Lemma ok_value_at_end : segment_of 3 3 1 zigzag = Some (Segment 3 (V3 0 0 9) 4 (V3 0 0 9)). Proof. computed. Qed.
Lemma ok_value_until_end : segment_of 4 6 2 zigzag = Some (Segment 2 (V3 0 0 0) 3 (V3 0 0 9)).
Proof. computed. Qed.
Lemma no_value_across : segment_of 4 7 2 zigzag = None. Proof. computed. Qed.
Lemma no_value_across_inside : segment_of 1 3 2 zigzag = None. Proof. computed. Qed.

(** Points from (0, 0, 0) and from (t, 1, 0): at distance 2 at the root of 3. *)
Definition leaving e := spaced 0 4 (fun v => if v =? 0 then at_rest o else [(0, V3 0 1 0); (4, V3 4 1 0)])
  2 (fun i => [i]) (fun i => i) [] e.
Definition hit_leaving e g l u := check_hit false (leaving e) (Witness 0 1 [(0, [1])] [(1, [1])] g l u 2).
Lemma ok_hit_root_3 : hit_leaving 2 [-3; 0; 1] 2 4 = true. Proof. computed. Qed.
Lemma no_hit_root_3 : hit_leaving 1 [-3; 0; 1] 2 4 = false. Proof. computed. Qed.
Lemma ok_hit_root_2_eta : hit_leaving 2 [-2; 0; 1] 2 3 = true. Proof. computed. Qed.
(** True at the root of 2, but not in all of the interval. *)
Lemma no_hit_root_2_eta : hit_leaving 2 [-2; 0; 1] 2 4 = false. Proof. computed. Qed.
Lemma no_hit_root_5 : hit_leaving 2 [-5; 0; 1] 4 6 = false. Proof. computed. Qed.

(** Neighbours: 0 and 2 have two edges between them, and are at distance 6. *)
Definition hit_links e k i j u v := check_hit false (links e k) (at_time 1 1 i j [(u, 1)] [(v, 1)]).
Lemma ok_hit_ring : hit_links 6 2 0 2 0 2 = true. Proof. computed. Qed.
Theorem unsafe_ring : forall strict, ~ never_touch strict (links 6 2).
Proof. exact (check_hit_sound_both _ _ ok_hit_ring). Qed.
Lemma no_hit_ring_eta : hit_links 5 2 0 2 0 2 = false. Proof. computed. Qed.
Lemma no_hit_ring : hit_links 6 3 0 2 0 2 = false. Proof. computed. Qed.
Lemma ok_hit_ring_3 : hit_links 9 3 0 2 0 3 = true. Proof. computed. Qed.
Lemma no_hit_ring_4 : hit_links 9 4 0 2 0 3 = false. Proof. computed. Qed.
Lemma no_hit_ring_back : hit_links 9 4 2 0 3 0 = false. Proof. computed. Qed.
Lemma ok_hit_ring_1 : hit_links 3 1 0 2 1 2 = true. Proof. computed. Qed.
Lemma no_hit_ring_2 : hit_links 3 2 0 2 1 2 = false. Proof. computed. Qed.
(** One vertex of a feature that is near is enough for it to be. *)
Lemma no_hit_ring_edge : check_hit false (links 9 2) (at_time 1 1 0 2 [(0, 1); (1, 0)] [(2, 0); (3, 1)]) = false.
Proof. computed. Qed.
Lemma ok_hit_ring_edge : check_hit false (links 9 2) (at_time 1 1 0 2 [(0, 1)] [(2, 0); (3, 1)]) = true.
Proof. computed. Qed.
(** However near neighbours may be: the folded chain has 3 at the place of 1. *)
Lemma ok_hit_folded : check_hit false (folded 9) (at_time 1 1 0 2 [(1, 1)] [(3, 1)]) = true. Proof. computed. Qed.
Lemma no_hit_folded : check_hit false (folded 9) (at_time 1 1 0 2 [(0, 1)] [(3, 1)]) = false. Proof. computed. Qed.
(** Through merged vertices: 0 and 3 are joined by way of 1, which 11 is merged with. *)
Definition hit_seam_ring f k :=
  let s := seam f (path hinge 2) in
  check_hit false (Scene 0 4 (path s) (same s) 2 (cell s) (label s) [] 99 k) (at_time 0 1 0 1 [(0, 1)] [(3, 1)]).
Lemma ok_hit_seam_ring : hit_seam_ring (fun v => v) 9 = true. Proof. computed. Qed.
Lemma ok_hit_seam_ring_2 : hit_seam_ring to_first 2 = true. Proof. computed. Qed.
Lemma no_hit_seam_ring : hit_seam_ring to_first 3 = false. Proof. computed. Qed.

(** ** Windows *)

Definition window t0 t1 tr : scene :=
  let s := over_tri tr in
  touching t0 t1 (fun v => if v =? 3 then tr else map (fun b => (if fst b =? 0 then t0 else t1, snd b)) (tri v))
        2 (cell s) (label s) [].
Definition w1 := window 0 4 [(0, V3 2 2 8); (1, V3 2 2 8); (4, V3 2 2 2)].
Definition w2 := window 4 7 [(4, V3 2 2 2); (7, V3 2 2 1)].
Definition w3 := window 7 9 [(7, V3 2 2 1); (8, V3 2 2 5); (9, V3 2 2 1)].

Lemma windows_fit : chain w1 [w2; w3].
Proof.
  assert (forall i v, 0 <= i < 2 -> In v (cell w1 i) -> v = 0 \/ v = 1 \/ v = 2 \/ v = 3) as V.
  { intros i v _. cbn. destruct (i =? 0); cbn; intuition. }
  repeat split; intros i v Hi Hv; destruct (V i v Hi Hv) as [-> | [-> | [-> | ->]]]; cbn;
    do 3 eexists; split;
    match goal with
    | |- [?a; ?b] = _ => exact (eq_refl ([a] ++ [b]))
    | |- [?a; ?b; ?c] = _ => exact (eq_refl ([a; b] ++ [c]))
    | |- _ => reflexivity
    end.
Qed.

Theorem windows_safe : never_touch false (glue_all w1 [w2; w3]).
Proof.
  apply chain_sound; [exact windows_fit|].
  repeat constructor; exists point_first, (close (TDirection up)); computed.
Qed.
Lemma windows_time : tbeg (glue_all w1 [w2; w3]) = 0 /\ tend (glue_all w1 [w2; w3]) = 9.
Proof. split; computed. Qed.
