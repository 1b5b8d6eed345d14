(* SPDX-License-Identifier: Apache-2.0 *)
(** * Integer polynomials: their signs in an interval, and divisibility

    What a witness of contact needs whose time is the root of a polynomial.  The first
    part computes with integers only, the second says what the answers mean over the reals.

    Notation: a polynomial is the list of its coefficients, the constant one first; an
    interval is [l/d, u/d].  A form is a list [f] of n+1 integers, for the number
    f0 x^n + f1 x^(n-1) y + ... + fn y^n.

    Not here: how often a polynomial is 0 in an interval. *)
Require Import ZArith List Bool Reals Lra Lia.
Import ListNotations.
Open Scope Z_scope.

(** ** Computation *)

Definition poly := list Z.

Fixpoint add (p q : poly) : poly :=
  match p, q with
  | [], _ => q
  | _, [] => p
  | a :: p', b :: q' => (a + b) :: add p' q'
  end.

(** A polynomial times an integer. *)
Definition scale (c : Z) (p : poly) : poly := map (fun a => c * a) p.

Definition sub (p q : poly) : poly := add p (scale (-1) q).

Fixpoint mul (p q : poly) : poly :=
  match p with
  | [] => []
  | a :: p' => add (scale a q) (0 :: mul p' q)
  end.

(** Without leading zeros: what follows must not depend on how a polynomial was computed. *)
Fixpoint trim (p : poly) : poly :=
  match p with
  | [] => []
  | a :: r => match trim r with [] => if a =? 0 then [] else [a] | r' => a :: r' end
  end.

(** A form times  l x + u y. *)
Definition blend (l u : Z) (f : list Z) : list Z := add (scale l f ++ [0]) (0 :: scale u f).

(** For a polynomial with n coefficients, its value at  (l x + u y) / (d (x + y))  as a form,
    multiplied by  (d (x + y))^(n-1), and the form  (d (x + y))^n. *)
Fixpoint forms (l u d : Z) (p : poly) : list Z * list Z :=
  match p with
  | [] => ([], [1])
  | c :: r => let fe := forms l u d r in (add (scale c (snd fe)) (blend l u (fst fe)), blend d d (snd fe))
  end.

(** The first of them, whose coefficients are Bernstein's on [l/d, u/d], each times a positive
    number: for degree n, the k-th one times  d^n  and the binomial coefficient of n and k. *)
Definition bernstein (l u d : Z) (p : poly) : list Z := fst (forms l u d (trim p)).

(** Why a polynomial is not negative, or positive, on all of [l/d, u/d]. *)
Definition nonnegative_on (l u d : Z) (p : poly) : bool := forallb (fun a => 0 <=? a) (bernstein l u d p).
Definition positive_on (l u d : Z) (p : poly) : bool :=
  match bernstein l u d p with [] => false | f => forallb (fun a => 0 <? a) f end.

(** The last of a list that begins with [a]. *)
Fixpoint last_of (a : Z) (r : list Z) : Z := match r with [] => a | b :: r' => last_of b r' end.

(** Why a polynomial is 0 somewhere in [l/d, u/d]: its values at the ends have different signs,
    or one is 0. *)
Definition changes_sign (l u d : Z) (p : poly) : bool :=
  match bernstein l u d p with [] => false | a :: r => a * last_of a r <=? 0 end.

(** [b] f - [a] t^k g, for f and g with the leading coefficient first, k being the difference of
    their lengths; [None] if f is shorter. *)
Fixpoint cancel (b a : Z) (f g : list Z) : option (list Z) :=
  match f, g with
  | _, [] => Some (scale b f)
  | [], _ :: _ => None
  | x :: f', y :: g' => match cancel b a f' g' with Some h => Some ((b * x - a * y) :: h) | None => None end
  end.

(** The polynomial [b] t^k + [g] divides [f], the leading coefficient first: its multiples are taken
    away until what is left is shorter.  [fuel] is a list as long as [f]. *)
Fixpoint reduces (fuel : list Z) (b : Z) (g f : list Z) : bool :=
  match f with
  | [] => true
  | a :: f' =>
      match cancel b a f' g, fuel with
      | Some h, _ :: k => reduces k b g h
      | Some _, [] => false
      | None, _ => forallb (fun c => c =? 0) f
      end
  end.

(** [g], whose leading coefficient is not 0, divides [p] over the rationals. *)
Definition divides (g p : poly) : bool :=
  match rev_append g [] with
  | [] => false
  | b :: g' => if b =? 0 then false else let f := rev_append p [] in reduces f b g' f
  end.

(** ** What it means *)
Open Scope R_scope.

(** The value of a polynomial. *)
Fixpoint eval (p : poly) (t : R) : R := match p with [] => 0 | a :: r => IZR a + t * eval r t end.

Lemma eval_add p : forall q t, eval (add p q) t = eval p t + eval q t.
Proof.
  induction p as [|a p IH]; destruct q as [|b q]; intros t; cbn; try lra. rewrite IH, plus_IZR. lra.
Qed.

Lemma eval_scale c p t : eval (scale c p) t = IZR c * eval p t.
Proof. induction p as [|a p IH]; cbn; [lra|]. unfold scale in IH. rewrite IH, mult_IZR. lra. Qed.

Lemma eval_sub p q t : eval (sub p q) t = eval p t - eval q t.
Proof. unfold sub. rewrite eval_add, eval_scale. lra. Qed.

Lemma eval_mul p q t : eval (mul p q) t = eval p t * eval q t.
Proof. induction p as [|a p IH]; cbn; [lra|]. rewrite eval_add, eval_scale. cbn. rewrite IH. lra. Qed.

Lemma eval_trim p t : eval (trim p) t = eval p t.
Proof.
  induction p as [|a p IH]; cbn; auto. rewrite <- IH. destruct (trim p) as [|b r]; cbn; [|lra].
  destruct (Z.eqb_spec a 0) as [->|]; cbn; lra.
Qed.

(** *** Forms *)

(** The value of a form. *)
Fixpoint form (x y : R) (f : list Z) : R :=
  match f with [] => 0 | a :: r => IZR a * x ^ length r + y * form x y r end.

Lemma form_snoc x y f : form x y (f ++ [0%Z]) = x * form x y f.
Proof. induction f as [|a f IH]; cbn; [lra|]. rewrite IH, app_length, Nat.add_1_r. cbn. lra. Qed.

Lemma form_add x y f : forall g, length f = length g ->
  form x y (add f g) = form x y f + form x y g /\ length (add f g) = length f.
Proof.
  induction f as [|a f IH]; destruct g as [|b g]; cbn; intros E; try easy; [split; [lra|auto]|].
  destruct (IH g) as [F L]; [lia|]. rewrite F, L, plus_IZR. injection E as ->. split; auto. lra.
Qed.

Lemma form_scale x y c f : form x y (scale c f) = IZR c * form x y f.
Proof.
  induction f as [|a f IH]; cbn; [lra|]. unfold scale in *. rewrite IH, map_length, mult_IZR. lra.
Qed.

Lemma form_blend x y l u f :
  form x y (blend l u f) = (IZR l * x + IZR u * y) * form x y f /\ length (blend l u f) = S (length f).
Proof.
  unfold blend.
  assert (length (scale l f ++ [0%Z]) = length (0%Z :: scale u f)) as E.
  { unfold scale. rewrite app_length; cbn. rewrite !map_length. lia. }
  apply (form_add x y) in E as [-> ->]. rewrite form_snoc. cbn. rewrite !form_scale.
  rewrite app_length. unfold scale. cbn. rewrite !map_length. split; [|lia].
  rewrite Rmult_0_l. ring.
Qed.

(** The forms have the value of the polynomial at a time between [l/d] and [u/d]. *)
Lemma forms_value l u d t x y p : x + y = 1 -> IZR d * t = IZR l * x + IZR u * y ->
  let fe := forms l u d p in
  length (fst fe) = length p /\ IZR d * form x y (fst fe) = IZR d ^ length p * eval p t /\
  length (snd fe) = S (length p) /\ form x y (snd fe) = IZR d ^ length p.
Proof.
  intros X T. induction p as [|c p (L1 & V1 & L2 & V2)]; cbn -[add]; [repeat split; lra|].
  set (fe := forms l u d p) in *.
  destruct (form_blend x y l u (fst fe)) as [B1 B2], (form_blend x y d d (snd fe)) as [B3 B4].
  destruct (form_add x y (scale c (snd fe)) (blend l u (fst fe))) as [A1 A2].
  { unfold scale. rewrite map_length. lia. }
  rewrite A1, A2, B1, B3, B4, form_scale, V2. repeat split; try lia.
  - unfold scale. rewrite map_length. lia.
  - replace (_ * (_ + _)) with
      (IZR d * (IZR c * IZR d ^ length p) + (IZR l * x + IZR u * y) * (IZR d * form x y (fst fe)))
      by ring. rewrite V1, <- T. ring.
  - replace (_ + _) with (IZR d * (x + y)) by ring. rewrite X. ring.
Qed.

(** A time in the interval as a mean of its ends. *)
Lemma between_ends l u t : l <= t <= u -> exists x y, 0 <= x /\ 0 <= y /\ x + y = 1 /\ t = l * x + u * y.
Proof.
  intros H. destruct (Req_dec l u) as [->|N].
  - exists 1, 0. lra.
  - exists ((u - t) / (u - l)), ((t - l) / (u - l)).
    assert (0 < / (u - l)) by (apply Rinv_0_lt_compat; lra).
    repeat split; try (apply Rmult_le_pos; lra); field; lra.
Qed.

Lemma form_nonnegative x y f : 0 <= x -> 0 <= y -> forallb (fun a => (0 <=? a)%Z) f = true -> 0 <= form x y f.
Proof.
  intros X Y; induction f as [|a f IH]; cbn; [lra|]. rewrite andb_true_iff. intros [A F].
  apply Z.leb_le, IZR_le in A. pose proof (pow_le x (length f) X). specialize (IH F).
  apply Rplus_le_le_0_compat; now apply Rmult_le_pos.
Qed.

Lemma form_positive x y f : 0 <= x -> 0 <= y -> x + y = 1 -> f <> [] ->
  forallb (fun a => (0 <? a)%Z) f = true -> 0 < form x y f.
Proof.
  intros X Y E; induction f as [|a f IH]; [easy|]. cbn. rewrite andb_true_iff. intros _ [A F].
  apply Z.ltb_lt, IZR_lt in A. destruct f as [|b f]; [cbn; lra|].
  assert (0 < form x y (b :: f)) as P by (apply IH; easy).
  pose proof (pow_le x (length (b :: f)) X). destruct Y as [Y| <-].
  - apply Rplus_le_lt_0_compat; [apply Rmult_le_pos; lra|now apply Rmult_lt_0_compat].
  - assert (x = 1) as -> by lra. rewrite pow1. lra.
Qed.

Section Interval.
Variables l u d : Z.
Hypothesis d_positive : (0 < d)%Z.

(** A form of a polynomial has its sign. *)
Lemma bernstein_value p t : IZR l <= t * IZR d <= IZR u ->
  exists x y k, 0 <= x /\ 0 <= y /\ x + y = 1 /\ 0 < k /\ k * form x y (bernstein l u d p) = eval p t.
Proof.
  intros H. apply between_ends in H as (x & y & X & Y & E & T). apply IZR_lt in d_positive as D.
  rewrite Rmult_comm in T. destruct (forms_value l u d t x y (trim p) E T) as (_ & V & _).
  exists x, y, (IZR d * / IZR d ^ length (trim p)). fold (bernstein l u d p) in V.
  assert (0 < IZR d ^ length (trim p)) as K by now apply pow_lt.
  repeat split; auto.
  - apply Rmult_lt_0_compat; auto. now apply Rinv_0_lt_compat.
  - rewrite <- eval_trim. apply (Rmult_eq_reg_l (IZR d ^ length (trim p))); [|lra].
    rewrite <- V. field. lra.
Qed.

Lemma nonnegative_sound p t : nonnegative_on l u d p = true -> IZR l <= t * IZR d <= IZR u -> 0 <= eval p t.
Proof.
  intros N H. apply (bernstein_value p) in H as (x & y & k & X & Y & _ & K & <-).
  apply Rmult_le_pos; [lra|]. now apply form_nonnegative.
Qed.

Lemma positive_sound p t : positive_on l u d p = true -> IZR l <= t * IZR d <= IZR u -> 0 < eval p t.
Proof.
  unfold positive_on. intros N H. apply (bernstein_value p) in H as (x & y & k & X & Y & E & K & <-).
  apply Rmult_lt_0_compat; auto. destruct (bernstein l u d p); [discriminate|]. now apply form_positive.
Qed.

Lemma eval_continuous p : continuity (eval p).
Proof.
  induction p as [|a p IH].
  - apply (continuity_const (eval [])). now intros x y.
  - apply (continuity_plus (fct_cte (IZR a)) (id * eval p)%F).
    + apply continuity_const. now intros x y.
    + apply continuity_mult; auto. apply derivable_continuous, derivable_id.
Qed.

Lemma form_first a r : form 1 0 (a :: r) = IZR a.
Proof. cbn. rewrite pow1. lra. Qed.

Lemma form_last r : forall a, form 0 1 (a :: r) = IZR (last_of a r).
Proof.
  induction r as [|b r IH]; intros a; [cbn; lra|]. cbn [last_of]. rewrite <- IH. cbn. lra.
Qed.

(** What changes its sign is 0 in between. *)
Lemma changes_sign_sound p : (l <= u)%Z -> changes_sign l u d p = true ->
  exists t, IZR l <= t * IZR d <= IZR u /\ eval p t = 0.
Proof.
  intros L. unfold changes_sign. apply IZR_lt in d_positive as D. apply IZR_le in L.
  set (k := IZR d ^ length (trim p)). assert (0 < k) as K by now apply pow_lt.
  destruct (forms_value l u d (IZR l / IZR d) 1 0 (trim p)) as (_ & V0 & _); [lra|field; lra|].
  destruct (forms_value l u d (IZR u / IZR d) 0 1 (trim p)) as (_ & V1 & _); [lra|field; lra|].
  fold (bernstein l u d p) k in V0, V1. rewrite eval_trim in V0, V1.
  destruct (bernstein l u d p) as [|a r]; [discriminate|]. rewrite form_first in V0. rewrite form_last in V1.
  intros S. apply Z.leb_le, IZR_le in S. rewrite mult_IZR in S.
  destruct (IVT_cor (eval p) (IZR l / IZR d) (IZR u / IZR d)) as (t & T & E).
  - apply eval_continuous.
  - apply Rmult_le_compat_r; auto. now apply Rlt_le, Rinv_0_lt_compat.
  - apply (Rmult_le_reg_l (k * k)); [now apply Rmult_lt_0_compat|].
    replace (k * k * _) with (k * eval p (IZR l / IZR d) * (k * eval p (IZR u / IZR d))) by ring.
    rewrite <- V0, <- V1.
    replace (_ * _) with (IZR d * IZR d * (IZR a * IZR (last_of a r))) by ring.
    assert (0 <= IZR d * IZR d) by (apply Rmult_le_pos; lra).
    rewrite Rmult_0_r. rewrite <- (Rmult_0_r (IZR d * IZR d)). now apply Rmult_le_compat_l.
  - exists t. split; auto. destruct T as [T0 T1].
    apply (Rmult_le_compat_r (IZR d)) in T0, T1; try lra.
    unfold Rdiv in T0, T1. rewrite Rmult_assoc, Rinv_l in T0, T1; lra.
Qed.
End Interval.

(** *** Divisibility *)

(** The value with the leading coefficient first. *)
Fixpoint high (t : R) (f : list Z) : R := match f with [] => 0 | a :: r => IZR a * t ^ length r + high t r end.

Lemma high_rev t p : high t (rev p) = eval p t.
Proof.
  assert (forall f a, high t (f ++ [a]) = IZR a + t * high t f) as S.
  { induction f as [|b f IH]; intros a; cbn; [lra|]. rewrite IH, app_length, Nat.add_1_r. cbn. lra. }
  induction p as [|a p IH]; cbn; auto. now rewrite S, IH.
Qed.

Lemma high_scale t c f : high t (scale c f) = IZR c * high t f.
Proof. induction f as [|a f IH]; cbn; [lra|]. unfold scale in *. rewrite IH, map_length, mult_IZR. lra. Qed.

Lemma cancel_sound t b a f : forall g h, cancel b a f g = Some h -> exists k,
  high t h = IZR b * high t f - IZR a * t ^ k * high t g /\
  length f = (k + length g)%nat /\ length h = length f.
Proof.
  induction f as [|x f IH]; intros [|y g] h; cbn [cancel]; try discriminate.
  - intros [= <-]. exists 0%nat. cbn. repeat split; lra.
  - intros E. assert (h = scale b (x :: f)) as -> by congruence. exists (length (x :: f)). rewrite high_scale.
    unfold scale. rewrite map_length. cbn [high length]. repeat split; [lra|lia].
  - destruct (cancel b a f g) as [h'|] eqn:E; [|discriminate]. intros [= <-].
    apply IH in E as (k & V & L1 & L2). exists k. cbn. rewrite V, L2, L1, minus_IZR, !mult_IZR, pow_add.
    repeat split; [ring|lia].
Qed.

Lemma reduces_sound t b g : b <> 0%Z -> high t (b :: g) = 0 -> forall fuel f,
  reduces fuel b g f = true -> high t f = 0.
Proof.
  intros B G fuel.
  assert (forall f, forallb (fun c => (c =? 0)%Z) f = true -> high t f = 0) as Z0.
  { induction f as [|c f IH]; cbn; auto. rewrite andb_true_iff. intros [C F].
    apply Z.eqb_eq in C as ->. rewrite IH by auto. lra. }
  assert (forall a f h, cancel b a f g = Some h -> high t h = 0 -> high t (a :: f) = 0) as S.
  { intros a f h E H. apply (cancel_sound t) in E as (k & V & L & _). cbn in G |- *.
    rewrite H in V. rewrite L, pow_add. apply not_0_IZR in B. apply (Rmult_eq_reg_l (IZR b)); auto.
    replace (high t g) with (- (IZR b * t ^ length g)) in V by lra. lra. }
  induction fuel as [|c fuel IH]; intros [|a f]; cbn [reduces]; auto;
    destruct (cancel b a f g) as [h|] eqn:E; try discriminate; auto.
  intros R. apply (S a f h E). now apply IH.
Qed.

(** Where [g] is 0, so is what it divides. *)
Lemma divides_sound g p t : divides g p = true -> eval g t = 0 -> eval p t = 0.
Proof.
  unfold divides. rewrite !rev_append_rev, !app_nil_r, <- !high_rev.
  destruct (rev g) as [|b g']; [discriminate|]. destruct (Z.eqb_spec b 0) as [|B]; [discriminate|].
  intros D G. eapply reduces_sound; eauto.
Qed.
