(* SPDX-License-Identifier: Apache-2.0 *)
(** * The formulas of the code

    Each is written once, with a parameter r: what is done with the outcome of every
    operation.  With [rnd] it is what the code computes, in the code's order of
    operations; with [exact] it is the real number that this stands for.  The C++
    expression is in the comment.

    Not here: any claim. *)
Require Import Reals.
Open Scope R_scope.

Definition exact (x : R) := x.

Record vec := Vec { x0 : R; x1 : R; x2 : R }.

(** Of all three components. *)
Definition each (P : R -> Prop) (a : vec) := P (x0 a) /\ P (x1 a) /\ P (x2 a).

(** {a[0] - b[0], a[1] - b[1], a[2] - b[2]} *)
Definition minus (r : R -> R) a b := Vec (r (x0 a - x0 b)) (r (x1 a - x1 b)) (r (x2 a - x2 b)).

(** n[0] * d[0] + n[1] * d[1] + n[2] * d[2] *)
Definition dot (r : R -> R) n d := r (r (r (x0 n * x0 d) + r (x1 n * x1 d)) + r (x2 n * x2 d)).

(** a * d - b * c *)
Definition det2 (r : R -> R) a b c d := r (r (a * d) - r (b * c)).

(** cross_component(a, b, axis) = a[i] * b[j] - a[j] * b[i], with i, j the axes that follow *)
Definition cross (r : R -> R) a b :=
  Vec (det2 r (x1 a) (x2 a) (x1 b) (x2 b))
      (det2 r (x2 a) (x0 a) (x2 b) (x0 b))
      (det2 r (x0 a) (x1 a) (x0 b) (x1 b)).

(** {a[0] + b[0], a[1] + b[1], a[2] + b[2]} *)
Definition plus (r : R -> R) a b := Vec (r (x0 a + x0 b)) (r (x1 a + x1 b)) (r (x2 a + x2 b)).

(** (1 - t) a0 + t a1 *)
Definition at_time t a0 a1 := Vec ((1 - t) * x0 a0 + t * x0 a1) ((1 - t) * x1 a0 + t * x1 a1)
                                  ((1 - t) * x2 a0 + t * x2 a1).

(** ** kernel/double_filter.h: coefficients of a moving determinant, times 3, and of a moving cross
    product, times 2; a0, a1 is the vector a at both ends of the step, and so on. *)

(** outer = dot(c, cross(a, b)) at one end, and then times N - 1 = 3 *)
Definition outer (r : R -> R) a b c := r (3 * dot r c (cross r a b)).

(** inner = dot(swapped(c), ends) + dot(c, middle), where swapped(c) is c' and ends = cross(a, b), at
    one end *)
Definition inner (r : R -> R) a b c c' a0 a1 b0 b1 :=
  r (dot r c' (cross r a b) + dot r c (plus r (cross r a0 b1) (cross r a1 b0))).

(** a.at_t0 x b.at_t1 + a.at_t1 x b.at_t0, one component of it: a = (p, q), b = (s, t) *)
Definition det2_middle (r : R -> R) p0 q0 p1 q1 s0 t0 s1 t1 := r (det2 r p0 q0 s1 t1 + det2 r p1 q1 s0 t0).

(** ** kernel/bernstein.h *)

(** c0 * y + c1 * x *)
Definition lerp (r : R -> R) c0 c1 y x := r (r (c0 * y) + r (c1 * x)).

(** value_at: y = 1 - x; p0 = c[0] * y + c[1] * x, p1 = c[1] * y + c[2] * x; p0 * y + p1 * x *)
Definition quadratic_value (r : R -> R) c0 c1 c2 x := let y := r (1 - x) in
  lerp r (lerp r c0 c1 y x) (lerp r c1 c2 y x) y x.

Definition cubic_value (r : R -> R) c0 c1 c2 c3 x := let y := r (1 - x) in
  let p0 := lerp r c0 c1 y x in let p1 := lerp r c1 c2 y x in let p2 := lerp r c2 c3 y x in
  lerp r (lerp r p0 p1 y x) (lerp r p1 p2 y x) y x.
