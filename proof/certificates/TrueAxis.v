(* TrueAxis.v: what a chain of bodies means, over the real numbers of Coq's standard library.

   The fixed library of every certificate that trueaxis writes. Parts 1 and 2 are definitions, to be read: a certificate
   says what they say. Parts 3 to 7 are proofs, which Coq checks: nobody has to read them. *)

From Coq Require Export Reals List Lra.
From Coq Require Import ZArith Lia.
Export ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------------------------------------------------------- *)
(* 1. An instrument *)

Inductive axis := X | Y | Z.

(* A rotation by an angle in radians about an axis, right-handed, or a translation by a length along it. *)
Inductive motion := Rot (about : axis) (angle : R) | Tr (along : axis) (length : R).
Notation Rx := (Rot X). Notation Ry := (Rot Y). Notation Rz := (Rot Z).
Notation Tx := (Tr X). Notation Ty := (Tr Y). Notation Tz := (Tr Z).

Record vec := V { x : R; y : R; z : R }.

(* What is observed: a point is moved by rotations and translations, a direction by rotations only. *)
Inductive kind := Point | Direction.

Definition move (k : kind) (m : motion) (p : vec) : vec :=
  match m with
  | Rot X a => V (x p) (cos a * y p - sin a * z p) (sin a * y p + cos a * z p)
  | Rot Y a => V (cos a * x p + sin a * z p) (y p) (cos a * z p - sin a * x p)
  | Rot Z a => V (cos a * x p - sin a * y p) (sin a * x p + cos a * y p) (z p)
  | Tr a d =>
    match k, a with
    | Direction, _ => p
    | Point, X => V (x p + d) (y p) (z p)
    | Point, Y => V (x p) (y p + d) (z p)
    | Point, Z => V (x p) (y p) (z p + d)
    end
  end.

(* An instrument is the list of its motions from the ground up; it shows the vector p of its last body in the ground
   frame. *)
Definition shown (k : kind) (c : list motion) (p : vec) : vec := fold_right (move k) p c.

(* The way back, out of the frame of a body. *)
Definition opposite (m : motion) : motion := match m with Rot a angle => Rot a (- angle) | Tr a d => Tr a (- d) end.
Definition back (c : list motion) : list motion := rev (map opposite c).

(* Functions of angles that Coq's library does not have. *)
Definition cot (a : R) : R := cos a / sin a.
Definition sec (a : R) : R := / cos a.
Definition csc (a : R) : R := / sin a.

(* 0 before one threshold, 1 behind the other, linear between; a step where the two are one. *)
Definition ramp (a from to : R) : R :=
  if Req_EM_T from to then (if Rle_dec from a then 1 else 0) else Rmax 0 (Rmin 1 ((a - from) / (to - from))).

(* ---------------------------------------------------------------------------------------------------------------- *)
(* 2. First order, and orders above it *)

(* The values at 0 of a function, of its derivative, of the derivative of that, and so on. *)
Fixpoint derivatives (f : R -> R) (l : list R) : Prop :=
  match l with
  | [] => True
  | a :: r => f 0 = a /\ exists g, (forall t, derivable_pt_lim f t (g t)) /\ derivatives g r
  end.

(* The same for a vector, one list for each component. *)
Definition along (f : R -> vec) (lx ly lz : list R) : Prop :=
  derivatives (fun t => x (f t)) lx /\ derivatives (fun t => y (f t)) ly /\ derivatives (fun t => z (f t)) lz.

(* f' + f''/2 + f'''/6 + ... of a list f, f', f'', f''' ... *)
Fixpoint horner (k : nat) (l : list R) : R := match l with [] => 0 | a :: r => (a + horner (S k) r) / INR k end.
Definition taylor (l : list R) : R := horner 1 (tl l).

(* v is the error of f up to order n: f is what the instrument shows when every error is multiplied by t, so that it is
   as designed at t = 0 and as it stands at t = 1; v is the sum of the terms of degree 1 to n of f in t, at t = 1. *)
Definition error_to_order (n : nat) (f : R -> vec) (v : vec) : Prop :=
  exists lx ly lz, length lx = S n /\ length ly = S n /\ length lz = S n /\ along f lx ly lz
    /\ v = V (taylor lx) (taylor ly) (taylor lz).

(* Readings: components, angles and the length of a vector, to first order. The angles rest on Coq's arc tangent, and with
   it on the law of excluded middle besides the axioms of the real numbers. An axis, forwards or backwards: *)
Inductive signed := Plus (a : axis) | Minus (a : axis).
Definition component (a : axis) (p : vec) : R := match a with X => x p | Y => y p | Z => z p end.
Definition on (s : signed) (p : vec) : R := match s with Plus a => component a p | Minus a => - component a p end.

(* The square of the length of a vector, and of its part across an axis. *)
Definition square (p : vec) : R := x p * x p + y p * y p + z p * z p.
Definition across (s : signed) (p : vec) : R := square p - on s p * on s p.

(* The angle by which the part of q in the plane of two axes is turned from that of p, from the first towards the second
   axis, if it is less than a quarter turn. *)
Definition turned_by (s r : signed) (p q : vec) : R :=
  atan ((on s p * on r q - on r p * on s q) / (on s p * on s q + on r p * on r q)).
(* The angle above the plane across an axis. *)
Definition elevation (s : signed) (p : vec) : R := atan (on s p / sqrt (across s p)).

(* v is the error of a component up to order n; of an angle or a length, to first order: the derivative at t = 0. *)
Definition component_error (n : nat) (a : axis) (f : R -> vec) (v : R) : Prop :=
  exists l, length l = S n /\ derivatives (fun t => component a (f t)) l /\ v = taylor l.
Definition azimuth_error (s r : signed) (f : R -> vec) (v : R) : Prop :=
  derivable_pt_lim (fun t => turned_by s r (f 0) (f t)) 0 v.
(* Times the cosine of the elevation as designed. *)
Definition cross_elevation_error (s r : signed) (f : R -> vec) (v : R) : Prop :=
  derivable_pt_lim (fun t => turned_by s r (f 0) (f t) *
    (sqrt (on s (f 0) * on s (f 0) + on r (f 0) * on r (f 0)) / sqrt (square (f 0)))) 0 v.
Definition elevation_error (s : signed) (f : R -> vec) (v : R) : Prop :=
  derivable_pt_lim (fun t => elevation s (f t)) 0 v.
Definition zenith_distance_error (s : signed) (f : R -> vec) (v : R) : Prop :=
  derivable_pt_lim (fun t => PI / 2 - elevation s (f t)) 0 v.
Definition range_error (f : R -> vec) (v : R) : Prop :=
  derivable_pt_lim (fun t => sqrt (square (f t))) 0 v.

(* What one vector has more than another. *)
Definition less (p q : vec) : vec := V (x p - x q) (y p - y q) (z p - z q).
(* Values at numbers: v is the printed vector as far as this is rounded, component by component. *)
Definition rounded_to (v printed within : vec) : Prop :=
  Rabs (x v - x printed) <= x within /\ Rabs (y v - y printed) <= y within /\ Rabs (z v - z printed) <= z within.

(* v is what f shows up to order n, not only its error: less what the instrument shows as designed, it is the error. *)
Definition shown_to_order (n : nat) (f : R -> vec) (v : vec) : Prop := error_to_order n f (less v (f 0)).

(* ---------------------------------------------------------------------------------------------------------------- *)
(* 3. Rules of derivatives *)

Lemma same_limit f g t d : (forall t, f t = g t) -> derivable_pt_lim f t d -> derivable_pt_lim g t d.
Proof. intros E D eps P. destruct (D eps P) as [delta L]. exists delta. intros h N S. rewrite <- !E. now apply L. Qed.

Lemma same_derivatives f g l : (forall t, f t = g t) -> derivatives f l -> derivatives g l.
Proof.
  destruct l as [|a r]; cbn; [trivial|]. intros E [A (h & D & H)]. split; [now rewrite <- E|].
  exists h; split; [|exact H]. intro t. exact (same_limit f g t _ E (D t)).
Qed.

Lemma unique_derivatives l : forall f m, length l = length m -> derivatives f l -> derivatives f m -> l = m.
Proof.
  induction l as [|a l IH]; intros f [|b m] L; try discriminate L; [reflexivity|].
  intros [A (g & D & G)] [B (h & E & H)]. f_equal; [congruence|].
  apply (IH g); [now injection L|exact G|]. apply (same_derivatives h); [|exact H].
  intro t. exact (uniqueness_limite f t _ _ (E t) (D t)).
Qed.

Fixpoint add (l m : list R) : list R := match l, m with a :: l, b :: m => (a + b) :: add l m | _, _ => [] end.
Fixpoint sub (l m : list R) : list R := match l, m with a :: l, b :: m => (a - b) :: sub l m | _, _ => [] end.
Fixpoint opp (l : list R) : list R := match l with a :: l => - a :: opp l | [] => [] end.
Fixpoint mul (l : list R) : list R -> list R :=
  fix with_l (m : list R) : list R :=
    match l, m with a :: l', b :: m' => a * b :: add (mul l' m) (with_l m') | _, _ => [] end.
Fixpoint constant (n : nat) (a : R) : list R := match n with O => [] | S n => a :: constant n 0 end.
Definition identity (n : nat) : list R := match n with O => [] | S n => 0 :: constant n 1 end.

(* A polynomial in t, from its coefficients. *)
Fixpoint poly (l : list R) (t : R) : R := match l with [] => 0 | a :: r => a + t * poly r t end.
Fixpoint of_poly (n : nat) (l : list R) : list R :=
  match l with [] => constant n 0 | [a] => constant n a | a :: r => add (constant n a) (mul (identity n) (of_poly n r)) end.

(* The cosine and the sine of a function: c and s are their values at 0. *)
Fixpoint waves (n : nat) (c s : R) (l : list R) : list R * list R :=
  match n, l with
  | S n, _ :: r => let (cosine, sine) := waves n c s l in (c :: opp (mul sine r), s :: mul cosine r)
  | _, _ => ([], [])
  end.

Lemma derivatives_add l : forall f g m, derivatives f l -> derivatives g m -> derivatives (fun t => f t + g t) (add l m).
Proof.
  induction l as [|a l IH]; intros f g [|b m]; cbn; trivial.
  intros [A (f' & D & F)] [B (g' & E & G)]. split; [congruence|].
  exists (fun t => f' t + g' t). split; [|now apply IH].
  intro t. exact (derivable_pt_lim_plus f g t _ _ (D t) (E t)).
Qed.

Lemma derivatives_sub l : forall f g m, derivatives f l -> derivatives g m -> derivatives (fun t => f t - g t) (sub l m).
Proof.
  induction l as [|a l IH]; intros f g [|b m]; cbn; trivial.
  intros [A (f' & D & F)] [B (g' & E & G)]. split; [congruence|].
  exists (fun t => f' t - g' t). split; [|now apply IH].
  intro t. exact (derivable_pt_lim_minus f g t _ _ (D t) (E t)).
Qed.

Lemma derivatives_opp l : forall f, derivatives f l -> derivatives (fun t => - f t) (opp l).
Proof.
  induction l as [|a l IH]; intros f; cbn; trivial. intros [A (f' & D & F)]. split; [congruence|].
  exists (fun t => - f' t). split; [|now apply IH]. intro t. exact (derivable_pt_lim_opp f t _ (D t)).
Qed.

Lemma derivatives_mul l : forall f g m, derivatives f l -> derivatives g m -> derivatives (fun t => f t * g t) (mul l m).
Proof.
  induction l as [|a l IH]; intros f g m; [now destruct m|]. revert g.
  induction m as [|b m IHm]; intros g; [trivial|].
  intros F G. assert (F0 := F); assert (G0 := G). destruct F as [A (f' & D & F)], G as [B (g' & E & G)].
  change (mul (a :: l) (b :: m)) with (a * b :: add (mul l (b :: m)) (mul (a :: l) m)).
  split; [congruence|]. exists (fun t => f' t * g t + f t * g' t). split.
  - intro t. exact (derivable_pt_lim_mult f g t _ _ (D t) (E t)).
  - apply derivatives_add; [now apply IH|now apply IHm].
Qed.

Lemma derivatives_constant n : forall a, derivatives (fun _ => a) (constant n a).
Proof.
  induction n as [|n IH]; intro a; cbn; trivial. split; [reflexivity|]. exists (fun _ => 0). split; [|apply IH].
  intro t. exact (derivable_pt_lim_const a t).
Qed.

Lemma derivatives_identity n : derivatives (fun t => t) (identity n).
Proof.
  destruct n as [|n]; cbn; trivial. split; [reflexivity|]. exists (fun _ => 1). split; [|apply derivatives_constant].
  exact derivable_pt_lim_id.
Qed.

Lemma derivatives_poly n l : derivatives (poly l) (of_poly n l).
Proof.
  induction l as [|a [|b r] IH].
  - exact (derivatives_constant n 0).
  - apply (same_derivatives (fun _ => a)); [intro; cbn; ring|]. exact (derivatives_constant n a).
  - change (of_poly n (a :: b :: r)) with (add (constant n a) (mul (identity n) (of_poly n (b :: r)))).
    apply (derivatives_add _ (fun _ => a) (fun t => t * poly (b :: r) t)); [apply derivatives_constant|].
    apply (derivatives_mul _ (fun t => t)); [apply derivatives_identity|exact IH].
Qed.

Lemma derivatives_waves n : forall f l c s, cos (f 0) = c -> sin (f 0) = s -> derivatives f l ->
  derivatives (fun t => cos (f t)) (fst (waves n c s l)) /\ derivatives (fun t => sin (f t)) (snd (waves n c s l)).
Proof.
  induction n as [|n IH]; intros f l c s C S F; [split; exact I|].
  destruct l as [|a r]; [split; exact I|]. assert (F0 := F). destruct F as [A (g & D & G)].
  destruct (IH f (a :: r) c s C S F0) as [HC HS].
  cbn [waves]. destruct (waves n c s (a :: r)) as [cosine sine]. cbn [fst snd] in *. split; (split; [assumption|]).
  - exists (fun t => - (sin (f t) * g t)). split.
    + intro t. replace (- (sin (f t) * g t)) with (- sin (f t) * g t) by ring.
      exact (derivable_pt_lim_comp f cos t _ _ (D t) (derivable_pt_lim_cos _)).
    + apply derivatives_opp. now apply derivatives_mul.
  - exists (fun t => cos (f t) * g t). split; [|now apply derivatives_mul].
    intro t. exact (derivable_pt_lim_comp f sin t _ _ (D t) (derivable_pt_lim_sin _)).
Qed.

(* ---------------------------------------------------------------------------------------------------------------- *)
(* 4. A chain, motion by motion *)

(* What a chain c, a function of t, shows of the vector p, with its derivatives at t = 0. *)
Definition follows (k : kind) (c : R -> list motion) (p : vec) (lx ly lz : list R) : Prop :=
  along (fun t => shown k (c t) p) lx ly lz.

(* Its last body: the vector itself. *)
Lemma device k p (c : R -> list motion) n : (forall t, c t = []) ->
  follows k c p (constant n (x p)) (constant n (y p)) (constant n (z p)).
Proof.
  intro E. repeat split; (eapply same_derivatives; [|apply derivatives_constant]); intro t; now rewrite E.
Qed.

(* One more motion that does nothing. *)
Lemma no_rotation k a amount c p lx ly lz : (forall t, amount t = 0) ->
  follows k c p lx ly lz -> follows k (fun t => Rot a (amount t) :: c t) p lx ly lz.
Proof.
  intro Zero. assert (E : forall t q, move k (Rot a (amount t)) q = q).
  { intros t [qx qy qz]. rewrite Zero. destruct a; cbn; rewrite cos_0, sin_0; f_equal; ring. }
  intros (Fx & Fy & Fz).
  repeat split; (eapply same_derivatives; [|eassumption]); intro t; symmetry; exact (f_equal _ (E _ _)).
Qed.
Lemma no_translation k a amount c p lx ly lz : (forall t, amount t = 0) ->
  follows k c p lx ly lz -> follows k (fun t => Tr a (amount t) :: c t) p lx ly lz.
Proof.
  intro Zero. assert (E : forall t q, move k (Tr a (amount t)) q = q).
  { intros t [qx qy qz]. rewrite Zero. destruct k, a; cbn; f_equal; ring. }
  intros (Fx & Fy & Fz).
  repeat split; (eapply same_derivatives; [|eassumption]); intro t; symmetry; exact (f_equal _ (E _ _)).
Qed.
(* A direction is not translated. *)
Lemma translated_direction a amount c p lx ly lz :
  follows Direction c p lx ly lz -> follows Direction (fun t => Tr a (amount t) :: c t) p lx ly lz.
Proof. intro F. exact F. Qed.

(* One more rotation, by a polynomial in t whose value at 0 has the cosine cs and the sine sn. *)
Definition turns (cs sn : R) (coefficients l : list R) : list R * list R :=
  waves (length l) cs sn (of_poly (length l) coefficients).

Lemma value_of_poly l : poly l 0 = hd 0 l.
Proof. destruct l; cbn; ring. Qed.

Section Rotation.
Variables (k : kind) (amount : R -> R) (c : R -> list motion) (p : vec) (coefficients : list R) (cs sn : R).
Variables lx ly lz cosines sines : list R.
Hypothesis before : follows k c p lx ly lz.
Hypothesis is_poly : forall t, amount t = poly coefficients t.
Hypothesis cosine : cos (hd 0 coefficients) = cs.
Hypothesis sine : sin (hd 0 coefficients) = sn.
Hypothesis turning : turns cs sn coefficients lx = (cosines, sines).

Lemma turned : derivatives (fun t => cos (amount t)) cosines /\ derivatives (fun t => sin (amount t)) sines.
Proof.
  rewrite <- value_of_poly in cosine, sine.
  destruct (derivatives_waves (length lx) _ _ cs sn cosine sine (derivatives_poly (length lx) coefficients)) as [C S].
  unfold turns in turning. rewrite turning in C, S.
  split; (eapply same_derivatives; [|eassumption]); intro t; now rewrite is_poly.
Qed.

Lemma rotated_x ly' lz' : sub (mul cosines ly) (mul sines lz) = ly' -> add (mul sines ly) (mul cosines lz) = lz' ->
  follows k (fun t => Rot X (amount t) :: c t) p lx ly' lz'.
Proof.
  destruct before as (Fx & Fy & Fz), turned as [C S]. intros <- <-. repeat split; [exact Fx| |].
  - exact (derivatives_sub _ _ _ _ (derivatives_mul _ _ _ _ C Fy) (derivatives_mul _ _ _ _ S Fz)).
  - exact (derivatives_add _ _ _ _ (derivatives_mul _ _ _ _ S Fy) (derivatives_mul _ _ _ _ C Fz)).
Qed.
Lemma rotated_y lx' lz' : add (mul cosines lx) (mul sines lz) = lx' -> sub (mul cosines lz) (mul sines lx) = lz' ->
  follows k (fun t => Rot Y (amount t) :: c t) p lx' ly lz'.
Proof.
  destruct before as (Fx & Fy & Fz), turned as [C S]. intros <- <-. repeat split; [|exact Fy|].
  - exact (derivatives_add _ _ _ _ (derivatives_mul _ _ _ _ C Fx) (derivatives_mul _ _ _ _ S Fz)).
  - exact (derivatives_sub _ _ _ _ (derivatives_mul _ _ _ _ C Fz) (derivatives_mul _ _ _ _ S Fx)).
Qed.
Lemma rotated_z lx' ly' : sub (mul cosines lx) (mul sines ly) = lx' -> add (mul sines lx) (mul cosines ly) = ly' ->
  follows k (fun t => Rot Z (amount t) :: c t) p lx' ly' lz.
Proof.
  destruct before as (Fx & Fy & Fz), turned as [C S]. intros <- <-. repeat split; [| |exact Fz].
  - exact (derivatives_sub _ _ _ _ (derivatives_mul _ _ _ _ C Fx) (derivatives_mul _ _ _ _ S Fy)).
  - exact (derivatives_add _ _ _ _ (derivatives_mul _ _ _ _ S Fx) (derivatives_mul _ _ _ _ C Fy)).
Qed.
End Rotation.

(* One more translation of a point, by a polynomial in t. *)
Section Translation.
Variables (amount : R -> R) (c : R -> list motion) (p : vec) (coefficients lx ly lz l' : list R).
Hypothesis before : follows Point c p lx ly lz.
Hypothesis is_poly : forall t, amount t = poly coefficients t.

Lemma moving n : derivatives amount (of_poly n coefficients).
Proof.
  apply (same_derivatives (poly coefficients)); [intro; now rewrite is_poly|apply derivatives_poly].
Qed.
Lemma translated_x : add lx (of_poly (length lx) coefficients) = l' ->
  follows Point (fun t => Tr X (amount t) :: c t) p l' ly lz.
Proof.
  destruct before as (Fx & Fy & Fz). intros <-. repeat split; [|exact Fy|exact Fz].
  exact (derivatives_add _ _ _ _ Fx (moving _)).
Qed.
Lemma translated_y : add ly (of_poly (length ly) coefficients) = l' ->
  follows Point (fun t => Tr Y (amount t) :: c t) p lx l' lz.
Proof.
  destruct before as (Fx & Fy & Fz). intros <-. repeat split; [exact Fx| |exact Fz].
  exact (derivatives_add _ _ _ _ Fy (moving _)).
Qed.
Lemma translated_z : add lz (of_poly (length lz) coefficients) = l' ->
  follows Point (fun t => Tr Z (amount t) :: c t) p lx ly l'.
Proof.
  destruct before as (Fx & Fy & Fz). intros <-. repeat split; [exact Fx|exact Fy|].
  exact (derivatives_add _ _ _ _ Fz (moving _)).
Qed.
End Translation.

(* ---------------------------------------------------------------------------------------------------------------- *)
(* 5. What follows for the error *)

Lemma same_vec a b c a' b' c' : a = a' -> b = b' -> c = c' -> V a b c = V a' b' c'.
Proof. now intros -> -> ->. Qed.

Lemma reached n f lx ly lz v :
  along f lx ly lz -> length lx = S n -> length ly = S n -> length lz = S n ->
  taylor lx = x v -> taylor ly = y v -> taylor lz = z v -> error_to_order n f v.
Proof.
  intros A Lx Ly Lz Tx Ty Tz. exists lx, ly, lz. repeat (split; [assumption|]). destruct v. cbn in *. congruence.
Qed.

(* The error up to an order is one vector, so that a formula for it that has another value somewhere is wrong. *)
Theorem one_error n f v w : error_to_order n f v -> error_to_order n f w -> v = w.
Proof.
  intros (lx & ly & lz & Lx & Ly & Lz & (Fx & Fy & Fz) & ->) (mx & my & mz & Mx & My & Mz & (Gx & Gy & Gz) & ->).
  rewrite (unique_derivatives lx _ mx (eq_trans Lx (eq_sym Mx)) Fx Gx).
  rewrite (unique_derivatives ly _ my (eq_trans Ly (eq_sym My)) Fy Gy).
  rewrite (unique_derivatives lz _ mz (eq_trans Lz (eq_sym Mz)) Fz Gz). reflexivity.
Qed.

(* The same of what is shown. *)
Lemma shown_reached n f a b d lx ly lz v :
  along f (a :: lx) (b :: ly) (d :: lz) -> length (a :: lx) = S n -> length (b :: ly) = S n -> length (d :: lz) = S n ->
  a + taylor (a :: lx) = x v -> b + taylor (b :: ly) = y v -> d + taylor (d :: lz) = z v -> shown_to_order n f v.
Proof.
  intros A Lx Ly Lz Tx Ty Tz. assert (B := A). destruct B as ((Ex & _) & (Ey & _) & (Ez & _)).
  apply (reached n f _ _ _ _ A Lx Ly Lz); unfold less; cbn [x y z]; lra.
Qed.
Theorem one_shown n f v w : shown_to_order n f v -> shown_to_order n f w -> v = w.
Proof.
  intros A B. assert (E := one_error _ _ _ _ A B). destruct v, w. unfold less in E. cbn in E.
  injection E. intros. f_equal; lra.
Qed.

(* The error up to first order is the derivative. *)
Theorem first_order_is_derivative f v : error_to_order 1 f v ->
  derivable_pt_lim (fun t => x (f t)) 0 (x v) /\ derivable_pt_lim (fun t => y (f t)) 0 (y v)
  /\ derivable_pt_lim (fun t => z (f t)) 0 (z v).
Proof.
  assert (one : forall g l, length l = 2%nat -> derivatives g l -> derivable_pt_lim g 0 (taylor l)).
  { intros g [|a [|b [|]]] L D; try discriminate L. destruct D as [_ (g' & D & E & _)].
    replace (taylor [a; b]) with (g' 0); [apply D|]. rewrite E. unfold taylor. cbn. field. }
  intros (lx & ly & lz & Lx & Ly & Lz & (Fx & Fy & Fz) & ->). cbn. auto.
Qed.

(* What follows for readings. *)

Lemma first_derivative g a b : derivatives g [a; b] -> g 0 = a /\ derivable_pt_lim g 0 b.
Proof. intros [A (h & D & B & _)]. split; [exact A|]. rewrite <- B. apply D. Qed.

Definition component_list (a : axis) (lx ly lz : list R) := match a with X => lx | Y => ly | Z => lz end.
Definition on_list (s : signed) (lx ly lz : list R) :=
  match s with Plus a => component_list a lx ly lz | Minus a => opp (component_list a lx ly lz) end.

Lemma derivatives_component a f lx ly lz : along f lx ly lz -> derivatives (fun t => component a (f t)) (component_list a lx ly lz).
Proof. intros (A & B & C). now destruct a. Qed.
Lemma derivatives_on s f lx ly lz : along f lx ly lz -> derivatives (fun t => on s (f t)) (on_list s lx ly lz).
Proof.
  intro A. destruct s; [now apply derivatives_component|]. 
  exact (derivatives_opp _ _ (derivatives_component _ _ _ _ _ A)).
Qed.

Lemma same_slope f g d e : (forall t, f t = g t) -> d = e -> derivable_pt_lim f 0 d -> derivable_pt_lim g 0 e.
Proof. intros E <-. now apply same_limit. Qed.

Section Slopes.
Variables (f : R -> vec) (x0 x1 y0 y1 z0 z1 : R).
Hypothesis A : along f [x0; x1] [y0; y1] [z0; z1].

Lemma slope_square : square (f 0) = x0 * x0 + y0 * y0 + z0 * z0 /\
  derivable_pt_lim (fun t => square (f t)) 0 (2 * (x0 * x1 + y0 * y1 + z0 * z1)).
Proof.
  destruct A as (Ax & Ay & Az).
  apply first_derivative in Ax, Ay, Az. destruct Ax as [X0 DX], Ay as [Y0 DY], Az as [Z0 DZ]. cbv beta in X0, Y0, Z0.
  split; [unfold square; now rewrite X0, Y0, Z0|].
  eapply same_slope; [intro; reflexivity| |
    exact (derivable_pt_lim_plus _ _ _ _ _ (derivable_pt_lim_plus _ _ _ _ _ (derivable_pt_lim_mult _ _ _ _ _ DX DX)
      (derivable_pt_lim_mult _ _ _ _ _ DY DY)) (derivable_pt_lim_mult _ _ _ _ _ DZ DZ))].
  cbv beta. rewrite X0, Y0, Z0. ring.
Qed.

Lemma slope_on s a b : on_list s [x0; x1] [y0; y1] [z0; z1] = [a; b] -> on s (f 0) = a /\ derivable_pt_lim (fun t => on s (f t)) 0 b.
Proof. intro L. apply (first_derivative (fun t => on s (f t))). rewrite <- L. now apply derivatives_on. Qed.

Lemma slope_turned s r a0 a1 b0 b1 :
  on_list s [x0; x1] [y0; y1] [z0; z1] = [a0; a1] -> on_list r [x0; x1] [y0; y1] [z0; z1] = [b0; b1] ->
  a0 * a0 + b0 * b0 <> 0 ->
  derivable_pt_lim (fun t => turned_by s r (f 0) (f t)) 0 ((a0 * b1 - b0 * a1) / (a0 * a0 + b0 * b0)).
Proof.
  intros L M N. apply slope_on in L, M. destruct L as [L D], M as [M E].
  set (above := fun t => on s (f 0) * on r (f t) - on r (f 0) * on s (f t)).
  set (below := fun t => on s (f 0) * on s (f t) + on r (f 0) * on r (f t)).
  assert (DA : derivable_pt_lim above 0 (a0 * b1 - b0 * a1)).
  { rewrite <- L, <- M. exact (derivable_pt_lim_minus _ _ _ _ _ (derivable_pt_lim_scal _ _ _ _ E) (derivable_pt_lim_scal _ _ _ _ D)). }
  assert (DB : derivable_pt_lim below 0 (a0 * a1 + b0 * b1)).
  { rewrite <- L, <- M. exact (derivable_pt_lim_plus _ _ _ _ _ (derivable_pt_lim_scal _ _ _ _ D) (derivable_pt_lim_scal _ _ _ _ E)). }
  assert (A0 : above 0 = 0) by (unfold above; ring).
  assert (B0 : below 0 = a0 * a0 + b0 * b0) by (unfold below; now rewrite L, M).
  assert (NB : below 0 <> 0) by now rewrite B0.
  eapply same_slope; [intro; reflexivity| |
    exact (derivable_pt_lim_comp _ atan _ _ _ (derivable_pt_lim_div _ _ _ _ _ DA DB NB) (derivable_pt_lim_atan _))].
  unfold div_fct, Rsqr. cbv beta. rewrite A0, B0. field. exact N.
Qed.

Lemma slope_root g q q' h : derivable_pt_lim g 0 q' -> g 0 = q -> 0 < h -> h * h = q ->
  derivable_pt_lim (fun t => sqrt (g t)) 0 (q' / (2 * h)).
Proof.
  intros D E P S. assert (Q : sqrt (g 0) = h) by (rewrite E, <- S; apply sqrt_square; lra).
  assert (G : 0 < g 0) by (rewrite E, <- S; now apply Rmult_lt_0_compat).
  eapply same_slope; [intro; reflexivity| |exact (derivable_pt_lim_comp _ sqrt _ _ _ D (derivable_pt_lim_sqrt _ G))].
  cbv beta. rewrite Q. field. lra.
Qed.

Lemma slope_elevation s c0 c1 h : on_list s [x0; x1] [y0; y1] [z0; z1] = [c0; c1] ->
  0 < h -> h * h = x0 * x0 + y0 * y0 + z0 * z0 - c0 * c0 ->
  derivable_pt_lim (fun t => elevation s (f t)) 0
    ((c1 * (h * h) - c0 * (x0 * x1 + y0 * y1 + z0 * z1 - c0 * c1)) / (h * (h * h + c0 * c0))).
Proof.
  intros L P S. apply slope_on in L. destruct L as [L D], slope_square as [Q E].
  assert (C : derivable_pt_lim (fun t => across s (f t)) 0 (2 * (x0 * x1 + y0 * y1 + z0 * z1) - 2 * (c0 * c1))).
  { eapply same_slope; [intro; reflexivity| |exact (derivable_pt_lim_minus _ _ _ _ _ E (derivable_pt_lim_mult _ _ _ _ _ D D))].
    cbv beta. rewrite L. ring. }
  assert (C0 : across s (f 0) = x0 * x0 + y0 * y0 + z0 * z0 - c0 * c0) by (unfold across; now rewrite L, Q).
  assert (H := slope_root _ _ _ _ C C0 P S).
  assert (R0 : sqrt (across s (f 0)) = h) by (rewrite C0, <- S; apply sqrt_square; lra).
  assert (N : sqrt (across s (f 0)) <> 0) by (rewrite R0; lra).
  eapply same_slope; [intro; reflexivity| |
    exact (derivable_pt_lim_comp _ atan _ _ _ (derivable_pt_lim_div _ _ _ _ _ D H N) (derivable_pt_lim_atan _))].
  unfold div_fct, Rsqr. cbv beta. rewrite R0, L. field.
  assert (0 < h * h) by now apply Rmult_lt_0_compat.
  assert (0 <= c0 * c0) by (destruct (Rle_dec 0 c0); [apply Rmult_le_pos; lra|replace (c0 * c0) with ((-c0) * (-c0)) by ring; apply Rmult_le_pos; lra]).
  repeat split; lra.
Qed.

Lemma quotient v above below : below <> 0 -> v * below = above -> above / below = v.
Proof. intros N <-. now field. Qed.

Theorem azimuth_reached s r a0 a1 b0 b1 v :
  on_list s [x0; x1] [y0; y1] [z0; z1] = [a0; a1] -> on_list r [x0; x1] [y0; y1] [z0; z1] = [b0; b1] ->
  a0 * a0 + b0 * b0 <> 0 -> v * (a0 * a0 + b0 * b0) = a0 * b1 - b0 * a1 -> azimuth_error s r f v.
Proof.
  intros L M N E. eapply same_slope; [intro; reflexivity| |exact (slope_turned _ _ _ _ _ _ L M N)]. now apply quotient.
Qed.
Theorem cross_elevation_reached s r a0 a1 b0 b1 h d v :
  on_list s [x0; x1] [y0; y1] [z0; z1] = [a0; a1] -> on_list r [x0; x1] [y0; y1] [z0; z1] = [b0; b1] ->
  0 < h -> h * h = a0 * a0 + b0 * b0 -> 0 < d -> d * d = x0 * x0 + y0 * y0 + z0 * z0 ->
  v * (h * d) = a0 * b1 - b0 * a1 -> cross_elevation_error s r f v.
Proof.
  intros L M P S Q T E.
  assert (N : a0 * a0 + b0 * b0 <> 0) by (rewrite <- S; assert (0 < h * h) by (now apply Rmult_lt_0_compat); lra).
  assert (K := slope_turned _ _ _ _ _ _ L M N). apply slope_on in L, M.
  destruct L as [L _], M as [M _], slope_square as [U _].
  eapply same_slope; [intro t; apply Rmult_comm| |exact (derivable_pt_lim_scal _ _ _ _ K)].
  cbv beta. rewrite L, M, U, <- S, <- T, !sqrt_square, <- E by lra. field. lra.
Qed.
Theorem elevation_reached s c0 c1 h v :
  on_list s [x0; x1] [y0; y1] [z0; z1] = [c0; c1] -> 0 < h -> h * h = x0 * x0 + y0 * y0 + z0 * z0 - c0 * c0 ->
  v * (h * (h * h + c0 * c0)) = c1 * (h * h) - c0 * (x0 * x1 + y0 * y1 + z0 * z1 - c0 * c1) -> elevation_error s f v.
Proof.
  intros L P S E. eapply same_slope; [intro; reflexivity| |exact (slope_elevation _ _ _ _ L P S)].
  apply quotient; [|exact E].
  assert (0 < h * h) by now apply Rmult_lt_0_compat.
  assert (0 <= c0 * c0) by apply Rle_0_sqr.
  apply Rmult_integral_contrapositive_currified; lra.
Qed.
Theorem zenith_distance_reached s c0 c1 h v :
  on_list s [x0; x1] [y0; y1] [z0; z1] = [c0; c1] -> 0 < h -> h * h = x0 * x0 + y0 * y0 + z0 * z0 - c0 * c0 ->
  - v * (h * (h * h + c0 * c0)) = c1 * (h * h) - c0 * (x0 * x1 + y0 * y1 + z0 * z1 - c0 * c1) -> zenith_distance_error s f v.
Proof.
  intros L P S E. assert (D := elevation_reached _ _ _ _ _ L P S E).
  eapply same_slope; [intro; reflexivity| |exact (derivable_pt_lim_minus _ _ _ _ _ (derivable_pt_lim_const (PI / 2) 0) D)].
  ring.
Qed.
Theorem range_reached d v : 0 < d -> d * d = x0 * x0 + y0 * y0 + z0 * z0 -> v * d = x0 * x1 + y0 * y1 + z0 * z1 ->
  range_error f v.
Proof.
  intros P S E. destruct slope_square as [Q D].
  eapply same_slope; [intro; reflexivity| |exact (slope_root _ _ _ _ D Q P S)].
  rewrite <- E. field. lra.
Qed.
End Slopes.

Theorem component_reached n a f lx ly lz v : along f lx ly lz -> length (component_list a lx ly lz) = S n ->
  taylor (component_list a lx ly lz) = v -> component_error n a f v.
Proof. intros A L <-. exists (component_list a lx ly lz). split; [exact L|]. split; [now apply derivatives_component|reflexivity]. Qed.

Theorem one_component n a f v w : component_error n a f v -> component_error n a f w -> v = w.
Proof.
  intros (l & L & D & ->) (m & M & E & ->). now rewrite (unique_derivatives l _ m (eq_trans L (eq_sym M)) D E).
Qed.
Theorem one_azimuth s r f v w : azimuth_error s r f v -> azimuth_error s r f w -> v = w.
Proof. apply uniqueness_limite. Qed.
Theorem one_cross_elevation s r f v w : cross_elevation_error s r f v -> cross_elevation_error s r f w -> v = w.
Proof. apply uniqueness_limite. Qed.
Theorem one_elevation s f v w : elevation_error s f v -> elevation_error s f w -> v = w.
Proof. apply uniqueness_limite. Qed.
Theorem one_zenith_distance s f v w : zenith_distance_error s f v -> zenith_distance_error s f w -> v = w.
Proof. apply uniqueness_limite. Qed.
Theorem one_range f v w : range_error f v -> range_error f w -> v = w.
Proof. apply uniqueness_limite. Qed.

(* ---------------------------------------------------------------------------------------------------------------- *)
(* 6. Calculating with sines and cosines *)

Lemma squares a : sin a * sin a = 1 - cos a * cos a.
Proof. generalize (sin2_cos2 a). unfold Rsqr. lra. Qed.

(* The sine and cosine of one more multiple of an angle. *)
Lemma cos_next k a : cos ((k + 1) * a) = cos (k * a) * cos a - sin (k * a) * sin a.
Proof. rewrite Rmult_plus_distr_r, Rmult_1_l. apply cos_plus. Qed.
Lemma sin_next k a : sin ((k + 1) * a) = sin (k * a) * cos a + cos (k * a) * sin a.
Proof. rewrite Rmult_plus_distr_r, Rmult_1_l. apply sin_plus. Qed.

(* Every point of the circle belongs to an angle. *)
Lemma circle c s : c * c + s * s = 1 -> exists a, cos a = c /\ sin a = s.
Proof.
  intro U. assert (B : -1 <= c <= 1) by (split; nra).
  assert (exists a, 0 <= a <= PI /\ cos a = c) as (a & (A0 & A1) & C).
  { destruct (Req_EM_T c 1) as [->|N1]; [exists 0; split; [split; [lra|apply Rlt_le, PI_RGT_0]|apply cos_0]|].
    destruct (Req_EM_T c (-1)) as [->|N2]; [exists PI; split; [split; [apply Rlt_le, PI_RGT_0|lra]|apply cos_PI]|].
    destruct (IVT (fun a => c - cos a) 0 PI) as (a & A & E).
    - intro t. apply continuity_pt_minus; [apply continuity_pt_const; intros ? ?; reflexivity|apply continuity_cos].
    - apply PI_RGT_0.
    - rewrite cos_0. lra.
    - rewrite cos_PI. lra.
    - exists a. split; [exact A|lra]. }
  assert (S : sin a * sin a = s * s) by (rewrite squares, C; lra).
  assert (P : 0 <= sin a) by (apply sin_ge_0; assumption).
  destruct (Rle_dec 0 s) as [Q|Q].
  - exists a. split; [exact C|nra].
  - exists (- a). rewrite cos_neg, sin_neg. split; [exact C|nra].
Qed.

Lemma same_follows k c p lx ly lz lx' ly' lz' : follows k c p lx ly lz -> lx = lx' -> ly = ly' -> lz = lz' ->
  follows k c p lx' ly' lz'.
Proof. now intros H <- <- <-. Qed.
Lemma same_list (a b : R) l m : a = b -> l = m -> a :: l = b :: m.
Proof. now intros -> ->. Qed.

(* How a certificate calculates. It says itself by what rules equations between numbers are settled: which sums of
   angles occur, of which angles the squares of sine and cosine add up to one. *)
Ltac multiples := idtac.
Ltac angles := idtac.
Ltac settle := fail.
Ltac level := fail.
(* A sum that is not zero in other words. *)
Ltac known := match goal with H : ?d <> 0 |- ?e <> 0 => let E := fresh in assert (E : e = d) by level; rewrite E; exact H end.
Ltac nonzero := repeat split; repeat (apply Rmult_integral_contrapositive_currified || apply pow_nonzero);
  first [assumption | lra | known].

(* The sine or cosine of a sum of angles, and of one more multiple of an angle. *)
Ltac apart := repeat first [rewrite cos_plus | rewrite sin_plus | rewrite cos_neg | rewrite sin_neg];
  rewrite ?cos_0, ?sin_0, ?cos_PI2, ?sin_PI2, ?cos_PI, ?sin_PI.
Ltac sum_of_angles sum := transitivity sum; [apply f_equal; field|]; apart; multiples; settle.
Ltac next_multiple multiple := transitivity multiple; [apply f_equal; ring|];
  rewrite ?cos_next, ?sin_next, ?Rmult_1_l; multiples; settle.

Ltac calculate :=
  cbv beta iota zeta delta [turns waves mul add sub opp of_poly constant identity poly length hd tl x y z].
Ltac entries := calculate; repeat (apply same_list); try reflexivity; angles; settle.
Ltac is_polynomial := let t := fresh in intro t; calculate; angles; settle.
Ltac value := cbn [hd]; solve [reflexivity | exact cos_0 | exact sin_0 | angles; settle].
Ltac rotation rule before amount coefficients cs sn :=
  eapply (rule _ amount _ _ coefficients cs sn _ _ _ _ _ before);
  [is_polynomial | value | value | calculate; reflexivity | entries | entries].
Ltac rotate_x := rotation rotated_x.
Ltac rotate_y := rotation rotated_y.
Ltac rotate_z := rotation rotated_z.
Ltac translation rule before amount coefficients :=
  eapply (rule amount _ _ coefficients _ _ _ _ before); [is_polynomial | entries].
Ltac translate_x := translation translated_x.
Ltac translate_y := translation translated_y.
Ltac translate_z := translation translated_z.
Lemma taylor_1 a b : taylor [a; b] = b.
Proof. unfold taylor; cbn; field. Qed.
Lemma taylor_2 a b c : taylor [a; b; c] = b + c / 2.
Proof. unfold taylor; cbn; field. Qed.
Lemma taylor_3 a b c d : taylor [a; b; c; d] = b + c / 2 + d / 6.
Proof. unfold taylor; cbn; field. Qed.
Ltac total :=
  rewrite ?taylor_1, ?taylor_2, ?taylor_3; match goal with |- ?a = ?a => reflexivity | _ => settle end.
(* A square other than zero, as a product. *)
Ltac not_zero product := match goal with |- ?e <> 0 => replace e with product by settle; nonzero end.
Ltac positive := first [assumption | lra | repeat apply Rmult_lt_0_compat; assumption || lra].
(* Numbers, at quarter turns. *)
Ltac values :=
  rewrite ?cos_neg, ?sin_neg, ?cos_0, ?sin_0, ?cos_PI2, ?sin_PI2, ?cos_PI, ?sin_PI;
  first [lra | field; nonzero | idtac].
Ltac different H := exfalso; assert (P := PI_RGT_0); assert (Q := PI_4); lra.
(* An equation of numbers, cosines and sines of single angles being given, and a premise at such numbers. *)
Ltac numbers :=
  rewrite ?cos_neg, ?sin_neg, ?cos_0, ?sin_0, ?cos_PI2, ?sin_PI2, ?cos_PI, ?sin_PI;
  first [lra | field; nonzero].
Ltac at_numbers := repeat match goal with E : _ = _ |- _ => rewrite E; clear E end;
  rewrite ?cos_neg, ?sin_neg, ?cos_0, ?sin_0, ?cos_PI2, ?sin_PI2, ?cos_PI, ?sin_PI; lra.
Ltac premise H := first [assumption | reflexivity | apply H; at_numbers | at_numbers].

(* What an instrument without errors shows. *)
Lemma shown_of k c p a b d v : follows k c p [a] [b] [d] -> a = x v -> b = y v -> d = z v -> shown k (c 0) p = v.
Proof.
  intros ((A & _) & (B & _) & (D & _)) E F G. destruct v, (shown k (c 0) p). cbn in *. congruence.
Qed.

(* ---------------------------------------------------------------------------------------------------------------- *)
(* 7. Values at numbers *)

(* Whole numbers; Z is an axis here. *)
Notation whole := BinNums.Z.

(* Numbers by their syntax, so that Coq calculates with them. *)
Inductive term :=
  | Number (n : whole) | Ratio (p q : whole) | Pi | Opposite (a : term) | Sum (a b : term) | Product (a b : term) | Over (a : term)
  | Sine (a : term) | Cosine (a : term) | Power (a : term) (n : nat).

Fixpoint value (t : term) : R :=
  match t with
  | Number n => IZR n | Ratio p q => IZR p / IZR q | Pi => PI | Opposite a => - value a | Sum a b => value a + value b
  | Product a b => value a * value b | Over a => / value a | Sine a => sin (value a) | Cosine a => cos (value a)
  | Power a n => value a ^ n
  end.

(* Motions by such numbers. *)
Inductive step := Turn (about : axis) (angle : term) | Shift (along : axis) (length : term).

Section Balls.
Variable bits : whole.
Hypothesis bits_positive : (0 <= bits)%Z.
Definition scale : whole := Z.shiftl 1 bits.
Definition shift (n : whole) : whole := Z.shiftr n bits.
Definition ball : Set := option (whole * whole).
Definition inside (b : ball) (v : R) : Prop :=
  match b with None => True | Some (c, r) => Rabs (v * IZR scale - IZR c) <= IZR r end.

Lemma scale_is : scale = (2 ^ bits)%Z.
Proof. unfold scale. rewrite Z.shiftl_mul_pow2 by assumption. lia. Qed.
Lemma scale_positive : 0 < IZR scale.
Proof. rewrite scale_is. apply IZR_lt. now apply Z.pow_pos_nonneg. Qed.

(* A whole floor_of, rounded down. *)
Lemma floor_of a b : (b <> 0)%Z -> IZR (a / b) <= IZR a / IZR b <= IZR (a / b) + 1.
Proof.
  intro N. assert (E := Z.div_mod a b N). set (q := (a / b)%Z) in *. set (m := (a mod b)%Z) in *.
  assert (NR : IZR b <> 0) by now apply not_0_IZR.
  replace (IZR a / IZR b) with (IZR q + IZR m / IZR b)
    by (rewrite E at 1; rewrite plus_IZR, mult_IZR; now field).
  destruct (Z.lt_trichotomy b 0) as [L|[L|L]]; [|contradiction|].
  - assert (M := Z.mod_neg_bound a b L). fold m in M.
    assert (0 <= IZR m / IZR b <= 1); [|lra].
    replace (IZR m / IZR b) with (IZR (- m) / IZR (- b)) by (rewrite !opp_IZR; field; auto).
    assert (0 < IZR (- b)) by (apply IZR_lt; lia). split.
    + apply Rmult_le_pos; [apply IZR_le; lia|]. apply Rlt_le. now apply Rinv_0_lt_compat.
    + apply Rmult_le_reg_r with (IZR (- b)); [assumption|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. rewrite Rmult_1_r, Rmult_1_l. apply IZR_le; lia.
  - assert (M := Z.mod_pos_bound a b L). fold m in M.
    assert (0 < IZR b) by now apply IZR_lt.
    assert (0 <= IZR m / IZR b <= 1); [|lra]. split.
    + apply Rmult_le_pos; [apply IZR_le; lia|]. apply Rlt_le. now apply Rinv_0_lt_compat.
    + apply Rmult_le_reg_r with (IZR b); [assumption|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. rewrite Rmult_1_r, Rmult_1_l. apply IZR_le; lia.
Qed.
Lemma shifted a : IZR (shift a) <= IZR a / IZR scale <= IZR (shift a) + 1.
Proof.
  unfold shift. rewrite Z.shiftr_div_pow2 by assumption. rewrite scale_is. apply floor_of.
  assert (0 < 2 ^ bits)%Z by now apply Z.pow_pos_nonneg. lia.
Qed.

Definition b_opp (a : ball) : ball := match a with None => None | Some (c, r) => Some (Z.opp c, r) end.
Definition b_add (a b : ball) : ball :=
  match a, b with Some (c, r), Some (d, s) => Some (Z.add c d, Z.add r s) | _, _ => None end.
Definition b_mul (a b : ball) : ball :=
  match a, b with
  | Some (c, r), Some (d, s) =>
    Some (shift (c * d), shift (Z.abs c * s + Z.abs d * r + r * s) + 2)%Z
  | _, _ => None
  end.
Definition b_half (a : ball) : ball := match a with None => None | Some (c, r) => Some (c / 2, r / 2 + 1)%Z end.
Definition b_over (a : ball) : ball :=
  match a with
  | Some (c, r) =>
    if (r <? Z.abs c)%Z then Some (scale * scale / c, scale * scale * r / ((Z.abs c - r) * Z.abs c) + 2)%Z else None
  | None => None
  end.
(* The same with a larger radius, by so many units. *)
Definition wider (a : ball) (more : whole) : ball := match a with None => None | Some (c, r) => Some (c, r + more)%Z end.
Definition b_whole (n : whole) : ball := Some (n * scale, 0)%Z.


Lemma abs_between a b : Rabs a <= b <-> - b <= a <= b.
Proof.
  split.
  - intro H. assert (A := Rle_abs a). assert (B := Rle_abs (- a)). rewrite Rabs_Ropp in B. lra.
  - intros [A B]. now apply Rabs_le.
Qed.

Lemma inside_opp a v : inside a v -> inside (b_opp a) (- v).
Proof. destruct a as [[c r]|]; cbn; [|trivial]. rewrite opp_IZR, !abs_between. lra. Qed.
Lemma inside_add a b v w : inside a v -> inside b w -> inside (b_add a b) (v + w).
Proof. destruct a as [[c r]|], b as [[d s]|]; cbn; try trivial. rewrite !plus_IZR, !abs_between. lra. Qed.
Lemma inside_whole n : inside (b_whole n) (IZR n).
Proof. cbn. rewrite mult_IZR. apply abs_between. lra. Qed.
Lemma inside_wider a v w n : inside a v -> Rabs (w - v) * IZR scale <= IZR n -> inside (wider a n) w.
Proof.
  destruct a as [[c r]|]; cbn; [|trivial]. intros A B. rewrite plus_IZR.
  replace (w * IZR scale - IZR c) with ((w - v) * IZR scale + (v * IZR scale - IZR c)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult, (Rabs_right (IZR scale)); [lra|].
  assert (P := scale_positive). lra.
Qed.
Lemma inside_mul a b v w : inside a v -> inside b w -> inside (b_mul a b) (v * w).
Proof.
  destruct a as [[c r]|], b as [[d s]|]; cbn; try trivial. intros A B. assert (P := scale_positive).
  set (k := IZR scale) in *.
  destruct (shifted (c * d)) as [L1 L2]. destruct (shifted (Z.abs c * s + Z.abs d * r + r * s)) as [M1 M2].
  fold k in L1, L2, M1, M2. rewrite !plus_IZR. rewrite mult_IZR in L1, L2.
  rewrite !plus_IZR, !mult_IZR, !abs_IZR in M1, M2.
  set (e := v * k - IZR c) in *. set (f := w * k - IZR d) in *.
  assert (E : v * w * k = (IZR c * IZR d + (IZR c * f + IZR d * e + e * f)) / k)
    by (unfold e, f; field; lra).
  assert (F : Rabs (IZR c * f + IZR d * e + e * f) <= Rabs (IZR c) * IZR s + Rabs (IZR d) * IZR r + IZR r * IZR s).
  { eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat.
    - eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
      apply Rplus_le_compat; apply Rmult_le_compat_l; auto using Rabs_pos.
    - rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. }
  set (g := IZR c * f + IZR d * e + e * f) in *.
  set (h := Rabs (IZR c) * IZR s + Rabs (IZR d) * IZR r + IZR r * IZR s) in *.
  rewrite E. unfold Rdiv in *. rewrite Rmult_plus_distr_r.
  assert (G : Rabs (g * / k) <= h * / k).
  { rewrite Rabs_mult, (Rabs_right (/ k)) by (apply Rle_ge, Rlt_le, Rinv_0_lt_compat; lra).
    apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|exact F]. }
  rewrite abs_between in G |- *. lra.
Qed.
Lemma inside_half a v : inside a v -> inside (b_half a) (v / 2).
Proof.
  destruct a as [[c r]|]; cbn; [|trivial]. rewrite plus_IZR, !abs_between.
  assert (C := Z.div_mod c 2). assert (Q := Z.div_mod r 2).
  assert (CB := Z.mod_pos_bound c 2). assert (RB := Z.mod_pos_bound r 2).
  assert (C2 : IZR c = 2 * IZR (c / 2) + IZR (c mod 2)) by (rewrite <- mult_IZR, <- plus_IZR; f_equal; lia).
  assert (R2 : IZR r = 2 * IZR (r / 2) + IZR (r mod 2)) by (rewrite <- mult_IZR, <- plus_IZR; f_equal; lia).
  assert (0 <= IZR (c mod 2) <= 1) by (split; apply IZR_le; lia).
  assert (0 <= IZR (r mod 2) <= 1) by (split; apply IZR_le; lia).
  lra.
Qed.
Lemma inside_over a v : inside a v -> inside (b_over a) (/ v).
Proof.
  destruct a as [[c r]|]; cbn; [|trivial]. intro A. destruct (Z.ltb_spec r (Z.abs c)) as [L|]; cbn; [|trivial].
  assert (P := scale_positive). set (k := IZR scale) in *.
  assert (R0 : 0 <= IZR r) by (eapply Rle_trans; [apply Rabs_pos|exact A]).
  assert (LR : IZR r < Rabs (IZR c)) by (rewrite <- abs_IZR; now apply IZR_lt).
  assert (C0 : (c <> 0)%Z) by (intros ->; rewrite Rabs_R0 in LR; lra).
  assert (CR : IZR c <> 0) by now apply not_0_IZR.
  assert (R0Z : (0 <= r)%Z) by now apply le_IZR.
  assert (D0 : ((Z.abs c - r) * Z.abs c <> 0)%Z) by nia.
  destruct (floor_of (scale * scale) c C0) as [L1 L2].
  destruct (floor_of (scale * scale * r) _ D0) as [M1 M2].
  rewrite plus_IZR. rewrite !mult_IZR in *. rewrite minus_IZR, abs_IZR in M1, M2. fold k in L1, L2, M1, M2.
  set (e := v * k - IZR c) in *.
  assert (X : Rabs (v * k) >= Rabs (IZR c) - IZR r).
  { replace (v * k) with (IZR c + e) by (unfold e; ring).
    assert (T := Rabs_triang_inv (IZR c) (- e)). rewrite Rabs_Ropp in T.
    replace (IZR c - - e) with (IZR c + e) in T by ring. lra. }
  assert (X0 : v * k <> 0) by (intro Z0; rewrite Z0, Rabs_R0 in X; lra).
  assert (V0 : v <> 0) by (intros ->; lra).
  assert (E : / v * k = k * k / IZR c + - (k * k * e / (v * k * IZR c))) by (unfold e; field; repeat split; lra).
  assert (G : Rabs (- (k * k * e / (v * k * IZR c))) <= k * k * IZR r / ((Rabs (IZR c) - IZR r) * Rabs (IZR c))).
  { rewrite Rabs_Ropp. unfold Rdiv. rewrite Rabs_mult, Rabs_mult, Rabs_inv, (Rabs_mult (v * k)).
    rewrite (Rabs_right (k * k)) by nra.
    apply Rmult_le_compat; [|apply Rlt_le, Rinv_0_lt_compat| |].
    - apply Rmult_le_pos; [nra|apply Rabs_pos].
    - apply Rmult_lt_0_compat; now apply Rabs_pos_lt.
    - apply Rmult_le_compat_l; [nra|exact A].
    - apply Rinv_le_contravar.
      + apply Rmult_lt_0_compat; lra.
      + apply Rmult_le_compat_r; lra. }
  rewrite E. rewrite abs_between in G |- *. lra.
Qed.

(* An upper bound of the size of what is inside. *)
Definition most (a : ball) : option whole := match a with None => None | Some (c, r) => Some (Z.abs c + r)%Z end.
Lemma inside_most a v m : inside a v -> most a = Some m -> Rabs v * IZR scale <= IZR m.
Proof.
  destruct a as [[c r]|]; cbn; [|discriminate]. intros A [= <-]. rewrite plus_IZR, abs_IZR. assert (P := scale_positive).
  rewrite <- (Rabs_right (IZR scale)) by lra. rewrite <- Rabs_mult.
  replace (v * IZR scale) with (IZR c + (v * IZR scale - IZR c)) at 1 by ring.
  eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

(* Sine and cosine of a small angle, from two terms of their series. *)
Lemma sine_series v : Rabs v <= 1 -> Rabs (sin v - (v - v ^ 3 / 6)) <= Rabs v ^ 5 / 120.
Proof.
  assert (Plus : forall u, 0 <= u <= 1 -> Rabs (sin u - (u - u ^ 3 / 6)) <= u ^ 5 / 120).
  { intros u [A B]. assert (Q := PI2_1). destruct (sin_bound u 0 A ltac:(lra)) as [L U].
    unfold sin_approx, sin_term in L, U. cbn -[pow] in L, U.
    apply abs_between. split.
    - replace (u - u ^ 3 / 6) with ((-1) ^ 0 * (u ^ 1 / 1) + (-1) ^ 1 * (u ^ 3 / 6)) by (cbn; field).
      assert (0 <= u ^ 5) by now apply pow_le. 
      match type of L with ?l <= _ => replace l with ((-1) ^ 0 * (u ^ 1 / 1) + (-1) ^ 1 * (u ^ 3 / 6)) in L by (cbn; field) end.
      lra.
    - match type of U with _ <= ?l => replace l with (u - u ^ 3 / 6 + u ^ 5 / 120) in U by (cbn; field) end. lra. }
  intro H. destruct (Rle_dec 0 v) as [P|N].
  - rewrite (Rabs_right v) in * by lra. now apply Plus.
  - rewrite (Rabs_left v) in * by lra. assert (E := Plus (- v) ltac:(lra)). rewrite sin_neg in E.
    replace (- sin v - (- v - (- v) ^ 3 / 6)) with (- (sin v - (v - v ^ 3 / 6))) in E by (cbn; field).
    now rewrite Rabs_Ropp in E.
Qed.
Lemma cosine_series v : Rabs v <= 1 -> Rabs (cos v - (1 - v ^ 2 / 2)) <= Rabs v ^ 4 / 24.
Proof.
  intro H. assert (Q := PI2_1). apply abs_between in H. destruct (cos_bound v 0 ltac:(lra) ltac:(lra)) as [L U].
  unfold cos_approx, cos_term in L, U. cbn -[pow] in L, U.
  replace (Rabs v ^ 4) with (v ^ 4) by (rewrite RPow_abs, Rabs_right; [reflexivity|apply Rle_ge; replace (v ^ 4) with ((v ^ 2) ^ 2) by ring; apply pow2_ge_0]).
  assert (0 <= v ^ 4) by (replace (v ^ 4) with ((v ^ 2) ^ 2) by ring; apply pow2_ge_0).
  match type of L with ?l <= _ => replace l with (1 - v ^ 2 / 2) in L by (cbn; field) end.
  match type of U with _ <= ?l => replace l with (1 - v ^ 2 / 2 + v ^ 4 / 24) in U by (cbn; field) end.
  apply abs_between. lra.
Qed.

(* Of units per scale: a product, rounded up. *)
Definition up (a b : whole) : whole := (shift (a * b) + 1)%Z.
Lemma upwards a b v w : 0 <= v -> 0 <= w -> v * IZR scale <= IZR a -> w * IZR scale <= IZR b -> v * w * IZR scale <= IZR (up a b).
Proof.
  intros V W A B. assert (P := scale_positive). unfold up. rewrite plus_IZR. destruct (shifted (a * b)) as [_ U].
  rewrite mult_IZR in U. eapply Rle_trans; [|exact U]. apply Rmult_le_reg_r with (IZR scale); [assumption|].
  replace (IZR a * IZR b / IZR scale * IZR scale) with (IZR a * IZR b) by (field; lra).
  replace (v * w * IZR scale * IZR scale) with ((v * IZR scale) * (w * IZR scale)) by ring.
  apply Rmult_le_compat; try assumption; apply Rmult_le_pos; lra.
Qed.

Definition little (a : ball) : ball * ball :=
  match most a with
  | None => (None, None)
  | Some m =>
    if (m <=? scale)%Z then
      let square := b_mul a a in
      let m2 := up m m in
      let m4 := up m2 m2 in
      (wider (b_add (b_whole 1) (b_opp (b_half square))) (m4 / 24 + 1)%Z,
       wider (b_add a (b_opp (b_mul (b_mul a square) (b_over (b_whole 6))))) (up m4 m / 120 + 1)%Z)
    else (None, None)
  end.
Lemma inside_little a v : inside a v -> inside (fst (little a)) (cos v) /\ inside (snd (little a)) (sin v).
Proof.
  intro A. unfold little. destruct (most a) as [m|] eqn:M; [|split; exact I].
  destruct (Z.leb_spec m scale) as [L|]; [|split; exact I]. cbn [fst snd].
  assert (B := inside_most _ _ _ A M). assert (P := scale_positive). assert (N := Rabs_pos v).
  assert (S1 : Rabs v <= 1).
  { apply Rmult_le_reg_r with (IZR scale); [assumption|]. rewrite Rmult_1_l. eapply Rle_trans; [exact B|]. now apply IZR_le. }
  assert (B2 := upwards _ _ _ _ N N B B). assert (N2 : 0 <= Rabs v * Rabs v) by nra.
  assert (B4 := upwards _ _ _ _ N2 N2 B2 B2). assert (N4 : 0 <= Rabs v * Rabs v * (Rabs v * Rabs v)) by nra.
  assert (B5 := upwards _ _ _ _ N4 N B4 B).
  split.
  - apply inside_wider with (v := 1 - v ^ 2 / 2).
    + apply inside_add; [apply inside_whole|]. apply inside_opp. apply inside_half.
      replace (v ^ 2) with (v * v) by ring. now apply inside_mul.
    + destruct (floor_of (up (up m m) (up m m)) 24 ltac:(lia)) as [_ U]. rewrite plus_IZR. eapply Rle_trans; [|exact U].
      apply Rle_trans with (Rabs v ^ 4 / 24 * IZR scale).
      * apply Rmult_le_compat_r; [lra|]. now apply cosine_series.
      * replace (Rabs v ^ 4) with (Rabs v * Rabs v * (Rabs v * Rabs v)) by ring. lra.
  - apply inside_wider with (v := v + - (v * (v * v) * / 6)).
    + apply inside_add; [assumption|]. apply inside_opp. apply inside_mul; [|apply inside_over, inside_whole].
      apply inside_mul; [assumption|]. now apply inside_mul.
    + destruct (floor_of (up (up (up m m) (up m m)) m) 120 ltac:(lia)) as [_ U]. rewrite plus_IZR. eapply Rle_trans; [|exact U].
      apply Rle_trans with (Rabs v ^ 5 / 120 * IZR scale).
      * apply Rmult_le_compat_r; [lra|].
        replace (v + - (v * (v * v) * / 6)) with (v - v ^ 3 / 6) by field. now apply sine_series.
      * replace (Rabs v ^ 5) with (Rabs v * Rabs v * (Rabs v * Rabs v) * Rabs v) by ring. lra.
Qed.

(* Of any angle, from half of it. *)
Definition small : whole := Z.shiftl 1 (bits * 5 / 6).
Fixpoint wave (halvings : nat) (a : ball) : ball * ball :=
  match halvings with
  | O => little a
  | S n =>
    match most a with
    | None => (None, None)
    | Some m =>
      if (m <=? small)%Z then little a
      else
        let (c, s) := wave n (b_half a) in
        (b_add (b_whole 1) (b_opp (b_mul (b_whole 2) (b_mul s s))), b_mul (b_whole 2) (b_mul s c))
    end
  end.
Lemma inside_wave n : forall a v, inside a v -> inside (fst (wave n a)) (cos v) /\ inside (snd (wave n a)) (sin v).
Proof.
  induction n as [|n IH]; intros a v A; [now apply inside_little|]. cbn [wave].
  destruct (most a) as [m|]; [|split; exact I]. destruct (m <=? small)%Z; [now apply inside_little|].
  destruct (IH (b_half a) (v / 2) (inside_half _ _ A)) as [C S].
  destruct (wave n (b_half a)) as [c s]. cbn [fst snd] in *.
  replace v with (2 * (v / 2)) by field. rewrite cos_2a_sin, sin_2a. split.
  - replace (1 - 2 * sin (v / 2) * sin (v / 2)) with (1 + - (2 * (sin (v / 2) * sin (v / 2)))) by ring.
    apply inside_add; [apply inside_whole|]. apply inside_opp. apply inside_mul; [apply inside_whole|]. now apply inside_mul.
  - rewrite Rmult_assoc. apply inside_mul; [apply inside_whole|]. now apply inside_mul.
Qed.
End Balls.

(* Circumference: forty decimals, between which its sine changes sign. *)
Definition pi_unit : whole := (10 ^ 40)%Z.
Definition pi_digits : whole := 31415926535897932384626433832795028841971%Z.
Definition is_above (b : ball) : bool := match b with Some (c, r) => (r <? c)%Z | None => false end.
Lemma above_zero bits b v : (0 <= bits)%Z -> inside bits b v -> is_above b = true -> 0 < v.
Proof.
  intros B. destruct b as [[c r]|]; cbn; [|discriminate]. intros A L. apply Z.ltb_lt in L. apply IZR_lt in L.
  apply abs_between in A. assert (P := scale_positive bits B).
  destruct (Rle_dec v 0) as [N|N]; [|lra]. assert (v * IZR (scale bits) <= 0) by nra. lra.
Qed.
Definition fraction (bits p q : whole) : ball := b_mul bits (b_whole bits p) (b_over bits (b_whole bits q)).
Lemma inside_fraction bits p q : (0 <= bits)%Z -> inside bits (fraction bits p q) (IZR p * / IZR q).
Proof. intro B. apply inside_mul; [assumption|apply inside_whole; assumption|apply inside_over; [assumption|apply inside_whole; assumption]]. Qed.
Definition fine : whole := 320.
Lemma pi_between : IZR pi_digits <= PI * IZR pi_unit <= IZR pi_digits + 1.
Proof.
  assert (F : (0 <= fine)%Z) by (unfold fine; lia). assert (Q := PI2_1). assert (Q4 := PI_4).
  assert (U : 0 < IZR pi_unit) by (apply IZR_lt; reflexivity).
  assert (Sine : forall p, inside fine (snd (wave fine 100 (fraction fine p pi_unit))) (sin (IZR p * / IZR pi_unit))).
  { intro p. apply inside_wave; [assumption|]. now apply inside_fraction. }
  split.
  - destruct (Rle_dec (IZR pi_digits) (PI * IZR pi_unit)) as [H|H]; [exact H|exfalso].
    assert (A := above_zero fine _ _ F (Sine pi_digits) ltac:(vm_compute; reflexivity)).
    apply (Rlt_not_le _ _ A). apply sin_le_0.
    + apply Rmult_le_reg_r with (IZR pi_unit); [assumption|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r; lra.
    + apply Rle_trans with 4.
      * apply Rmult_le_reg_r with (IZR pi_unit); [assumption|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r, <- mult_IZR by lra.
        apply IZR_le. vm_compute. discriminate.
      * assert (3 <= PI); [|lra].
        destruct (Rle_dec 3 PI) as [G|G]; [exact G|exfalso].
        assert (B := above_zero fine _ _ F (Sine (3 * pi_unit)%Z) ltac:(vm_compute; reflexivity)).
        rewrite mult_IZR, Rmult_assoc, Rinv_r, Rmult_1_r in B by lra.
        apply (Rlt_not_le _ _ B). apply sin_le_0; lra.
  - destruct (Rle_dec (PI * IZR pi_unit) (IZR pi_digits + 1)) as [H|H]; [exact H|exfalso].
    assert (S1 := Sine (pi_digits + 1)%Z). assert (A := above_zero fine _ _ F (inside_opp _ _ _ S1) ltac:(vm_compute; reflexivity)).
    apply (Rlt_not_le _ _ A). rewrite plus_IZR. assert (0 <= sin ((IZR pi_digits + 1) * / IZR pi_unit)); [|lra].
    apply sin_ge_0.
    + apply Rmult_le_pos; [apply Rle_trans with (IZR pi_digits); [apply IZR_le; discriminate|lra]|].
      apply Rlt_le. apply Rinv_0_lt_compat. exact U.
    + apply Rmult_le_reg_r with (IZR pi_unit); [assumption|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r; lra.
Qed.
(* Numbers, by their syntax. *)
Section Numbers.
Variable bits : whole.
Hypothesis bits_positive : (0 <= bits)%Z.
Definition b_pi : ball := Some (pi_digits * scale bits / pi_unit, scale bits / pi_unit + 2)%Z.
Lemma inside_pi : inside bits b_pi PI.
Proof.
  unfold b_pi, inside. assert (P := scale_positive bits bits_positive). assert (B := pi_between).
  assert (U : 0 < IZR pi_unit) by (apply IZR_lt; reflexivity).
  destruct (floor_of (pi_digits * scale bits) pi_unit ltac:(discriminate)) as [A1 A2].
  destruct (floor_of (scale bits) pi_unit ltac:(discriminate)) as [B1 B2].
  rewrite mult_IZR in A1, A2. rewrite plus_IZR. set (k := IZR (scale bits)) in *.
  set (d := IZR pi_digits) in *. set (u := IZR pi_unit) in *.
  assert (E : PI * k = d * k / u + (PI * u - d) * (k / u)) by (field; lra).
  assert (K : 0 <= k / u) by (apply Rlt_le, Rdiv_lt_0_compat; lra).
  apply abs_between. rewrite E. assert (0 <= (PI * u - d) * (k / u) <= k / u) by nra. lra.
Qed.

Fixpoint b_pow (a : ball) (n : nat) : ball := match n with O => b_whole bits 1 | S n => b_mul bits a (b_pow a n) end.
Lemma inside_pow a v n : inside bits a v -> inside bits (b_pow a n) (v ^ n).
Proof. intro A. induction n as [|n IH]; [now apply inside_whole|]. now apply inside_mul. Qed.

Definition b_ratio (p q : whole) : ball := if (q =? 0)%Z then None else Some (p * scale bits / q, 1)%Z.
Lemma inside_ratio p q : inside bits (b_ratio p q) (IZR p / IZR q).
Proof.
  unfold b_ratio. destruct (Z.eqb_spec q 0) as [|N]; cbn [inside]; [exact I|].
  destruct (floor_of (p * scale bits) q N) as [L U]. rewrite mult_IZR in L, U. apply abs_between.
  replace (IZR p / IZR q * IZR (scale bits)) with (IZR p * IZR (scale bits) / IZR q)
    by (field; now apply not_0_IZR). lra.
Qed.

Fixpoint about (t : term) : ball :=
  match t with
  | Number n => b_whole bits n | Ratio p q => b_ratio p q | Pi => b_pi | Opposite a => b_opp (about a) | Sum a b => b_add (about a) (about b)
  | Product a b => b_mul bits (about a) (about b) | Over a => b_over bits (about a)
  | Sine a => snd (wave bits 100 (about a)) | Cosine a => fst (wave bits 100 (about a)) | Power a n => b_pow (about a) n
  end.
Lemma inside_about t : inside bits (about t) (value t).
Proof.
  induction t; cbn [about value]; auto using inside_whole, inside_ratio, inside_pi, inside_opp, inside_add, inside_mul, inside_over, inside_pow;
    now apply inside_wave.
Qed.

Definition of_step (s : step) : motion := match s with Turn a t => Rot a (value t) | Shift a t => Tr a (value t) end.
Definition of_terms (p : term * term * term) : vec := let '(a, b, c) := p in V (value a) (value b) (value c).
Definition balls : Set := ball * ball * ball.
Definition all_inside (b : balls) (v : vec) : Prop :=
  let '(p, q, r) := b in inside bits p (x v) /\ inside bits q (y v) /\ inside bits r (z v).
Definition all_about (p : term * term * term) : balls := let '(a, b, c) := p in (about a, about b, about c).
Definition b_sub (a b : ball) : ball := b_add a (b_opp b).
Definition moved (k : kind) (s : step) (b : balls) : balls :=
  let '(p, q, r) := b in
  match s with
  | Turn a t =>
    let (c, s) := wave bits 100 (about t) in
    let times := b_mul bits in
    match a with
    | X => (p, b_sub (times c q) (times s r), b_add (times s q) (times c r))
    | Y => (b_add (times c p) (times s r), q, b_sub (times c r) (times s p))
    | Z => (b_sub (times c p) (times s q), b_add (times s p) (times c q), r)
    end
  | Shift a t =>
    match k, a with
    | Direction, _ => b
    | Point, X => (b_add p (about t), q, r)
    | Point, Y => (p, b_add q (about t), r)
    | Point, Z => (p, q, b_add r (about t))
    end
  end.
Lemma inside_sub a b v w : inside bits a v -> inside bits b w -> inside bits (b_sub a b) (v - w).
Proof. intros A B. apply inside_add; [assumption|]. now apply inside_opp. Qed.
Lemma inside_moved k s b v : all_inside b v -> all_inside (moved k s b) (move k (of_step s) v).
Proof.
  destruct b as [[p q] r]. intros (P & Q & R). destruct s as [a t|a t].
  - cbn [moved of_step move]. destruct (inside_wave bits bits_positive 100 _ _ (inside_about t)) as [C S].
    destruct (wave bits 100 (about t)) as [c s]. cbn [fst snd] in C, S.
    destruct a; repeat split; cbn [x y z]; auto using inside_sub, inside_add, inside_mul.
  - assert (A := inside_about t). destruct k, a; cbn [moved of_step move]; repeat split; cbn [x y z]; auto using inside_add.
Qed.
Definition shows (k : kind) (c : list step) (p : term * term * term) : balls := fold_right (moved k) (all_about p) c.
Lemma inside_shows k c p : all_inside (shows k c p) (shown k (map of_step c) (of_terms p)).
Proof.
  induction c as [|s c IH].
  - destruct p as [[a b] d]. repeat split; apply inside_about.
  - now apply inside_moved.
Qed.

(* Whether what is inside one ball is as near to the second number as the third one says: certainly, or certainly not. *)
Definition is_near (a b w : ball) : bool :=
  match a, b, w with Some (c, r), Some (d, q), Some (e, u) => (Z.abs (c - d) + r + q + u <=? e)%Z | _, _, _ => false end.
Definition is_far (a b w : ball) : bool :=
  match a, b, w with Some (c, r), Some (d, q), Some (e, u) => (e + u + r + q <? Z.abs (c - d))%Z | _, _, _ => false end.
Lemma distance a b c d r q k : Rabs (a * k - c) <= r -> Rabs (b * k - d) <= q -> 0 < k ->
  Rabs (c - d) - r - q <= Rabs (a - b) * k <= Rabs (c - d) + r + q.
Proof.
  intros A B K. rewrite <- (Rabs_right k) at 1 2 by lra. rewrite <- Rabs_mult.
  assert (T := Rabs_triang (c - d) ((a * k - c) - (b * k - d))).
  assert (U := Rabs_triang ((a - b) * k) (- ((a * k - c) - (b * k - d)))).
  assert (W := Rabs_triang (a * k - c) (- (b * k - d))). rewrite Rabs_Ropp in U, W.
  replace (c - d + (a * k - c - (b * k - d))) with ((a - b) * k) in T by ring.
  replace ((a - b) * k + - (a * k - c - (b * k - d))) with (c - d) in U by ring.
  replace (a * k - c + - (b * k - d)) with (a * k - c - (b * k - d)) in W by ring. lra.
Qed.
Lemma near a b w v n h : inside bits a v -> inside bits b n -> inside bits w h -> is_near a b w = true -> Rabs (v - n) <= h.
Proof.
  destruct a as [[c r]|], b as [[d q]|], w as [[e u]|]; try discriminate. cbn. intros A B W L.
  assert (K := scale_positive bits bits_positive). destruct (distance _ _ _ _ _ _ _ A B K) as [_ M].
  apply Z.leb_le, IZR_le in L. rewrite !plus_IZR, abs_IZR, minus_IZR in L. apply abs_between in W.
  apply Rmult_le_reg_r with (IZR (scale bits)); [assumption|]. lra.
Qed.
Lemma far a b w v n h : inside bits a v -> inside bits b n -> inside bits w h -> is_far a b w = true -> ~ Rabs (v - n) <= h.
Proof.
  destruct a as [[c r]|], b as [[d q]|], w as [[e u]|]; try discriminate. cbn. intros A B W L.
  assert (K := scale_positive bits bits_positive). destruct (distance _ _ _ _ _ _ _ A B K) as [M _].
  apply Z.ltb_lt, IZR_lt in L. rewrite !plus_IZR, abs_IZR, minus_IZR in L. apply abs_between in W.
  intro N. apply (Rmult_le_compat_r (IZR (scale bits))) in N; lra.
Qed.
Definition all_near (a b w : balls) : bool :=
  let '(a1, a2, a3) := a in let '(b1, b2, b3) := b in let '(w1, w2, w3) := w in
  (is_near a1 b1 w1 && is_near a2 b2 w2 && is_near a3 b3 w3)%bool.
Definition some_far (a b w : balls) : bool :=
  let '(a1, a2, a3) := a in let '(b1, b2, b3) := b in let '(w1, w2, w3) := w in
  (is_far a1 b1 w1 || is_far a2 b2 w2 || is_far a3 b3 w3)%bool.
Lemma holds_there a b w v n h : all_inside a v -> all_inside b n -> all_inside w h -> all_near a b w = true -> rounded_to v n h.
Proof.
  destruct a as [[a1 a2] a3], b as [[b1 b2] b3], w as [[w1 w2] w3]. intros (A1 & A2 & A3) (B1 & B2 & B3) (W1 & W2 & W3) L.
  cbn in L. rewrite !Bool.andb_true_iff in L. destruct L as [[L1 L2] L3]. repeat split; eapply near; eassumption.
Qed.
Lemma differs_there a b w v n h : all_inside a v -> all_inside b n -> all_inside w h -> some_far a b w = true -> ~ rounded_to v n h.
Proof.
  destruct a as [[a1 a2] a3], b as [[b1 b2] b3], w as [[w1 w2] w3]. intros (A1 & A2 & A3) (B1 & B2 & B3) (W1 & W2 & W3) L.
  cbn in L. rewrite !Bool.orb_true_iff in L. intros (N1 & N2 & N3). destruct L as [[L|L]|L]; revert L.
  - intro L. exact (far _ _ _ _ _ _ A1 B1 W1 L N1).
  - intro L. exact (far _ _ _ _ _ _ A2 B2 W2 L N2).
  - intro L. exact (far _ _ _ _ _ _ A3 B3 W3 L N3).
Qed.
Lemma inside_terms p : all_inside (all_about p) (of_terms p).
Proof. destruct p as [[a b] c]. repeat split; apply inside_about. Qed.
Definition less_balls (a b : balls) : balls :=
  let '(a1, a2, a3) := a in let '(b1, b2, b3) := b in (b_sub a1 b1, b_sub a2 b2, b_sub a3 b3).
Lemma inside_less a b v w : all_inside a v -> all_inside b w -> all_inside (less_balls a b) (less v w).
Proof.
  destruct a as [[a1 a2] a3], b as [[b1 b2] b3]. intros (A1 & A2 & A3) (B1 & B2 & B3). repeat split; now apply inside_sub.
Qed.
End Numbers.

(* Two hundred bits behind the point. *)
Definition precise : whole := 200.
Lemma precise_positive : (0 <= precise)%Z. Proof. discriminate. Qed.
Lemma shown_holds k c p n w : all_near (shows precise k c p) (all_about precise n) (all_about precise w) = true ->
  rounded_to (shown k (map of_step c) (of_terms p)) (of_terms n) (of_terms w).
Proof.
  exact (holds_there precise precise_positive _ _ _ _ _ _ (inside_shows _ precise_positive k c p) (inside_terms _ precise_positive n)
    (inside_terms _ precise_positive w)).
Qed.
Lemma shown_differs k c p n w : some_far (shows precise k c p) (all_about precise n) (all_about precise w) = true ->
  ~ rounded_to (shown k (map of_step c) (of_terms p)) (of_terms n) (of_terms w).
Proof.
  exact (differs_there precise precise_positive _ _ _ _ _ _ (inside_shows _ precise_positive k c p)
    (inside_terms _ precise_positive n) (inside_terms _ precise_positive w)).
Qed.
Lemma change_holds k c d p q n w :
  all_near (less_balls (shows precise k c p) (shows precise k d q)) (all_about precise n) (all_about precise w) = true ->
  rounded_to (less (shown k (map of_step c) (of_terms p)) (shown k (map of_step d) (of_terms q))) (of_terms n) (of_terms w).
Proof.
  exact (holds_there precise precise_positive _ _ _ _ _ _
    (inside_less precise _ _ _ _ (inside_shows _ precise_positive k c p) (inside_shows _ precise_positive k d q))
    (inside_terms _ precise_positive n) (inside_terms _ precise_positive w)).
Qed.
Lemma change_differs k c d p q n w :
  some_far (less_balls (shows precise k c p) (shows precise k d q)) (all_about precise n) (all_about precise w) = true ->
  ~ rounded_to (less (shown k (map of_step c) (of_terms p)) (shown k (map of_step d) (of_terms q))) (of_terms n) (of_terms w).
Proof.
  exact (differs_there precise precise_positive _ _ _ _ _ _
    (inside_less precise _ _ _ _ (inside_shows _ precise_positive k c p) (inside_shows _ precise_positive k d q))
    (inside_terms _ precise_positive n) (inside_terms _ precise_positive w)).
Qed.

(* The syntax of a number, of a list of motions, of a vector. *)
Ltac term_of e :=
  lazymatch e with
  | IZR ?n => constr:(Number n)
  | IZR ?p / IZR ?q => constr:(Ratio p q)
  | - IZR (Zpos ?p) / IZR ?q => constr:(Ratio (Zneg p) q)
  | PI => constr:(Pi)
  | - ?a => let a := term_of a in constr:(Opposite a)
  | ?a + ?b => let a := term_of a in let b := term_of b in constr:(Sum a b)
  | ?a - ?b => let a := term_of a in let b := term_of b in constr:(Sum a (Opposite b))
  | ?a * ?b => let a := term_of a in let b := term_of b in constr:(Product a b)
  | ?a / ?b => let a := term_of a in let b := term_of b in constr:(Product a (Over b))
  | / ?a => let a := term_of a in constr:(Over a)
  | sin ?a => let a := term_of a in constr:(Sine a)
  | cos ?a => let a := term_of a in constr:(Cosine a)
  | tan ?a => let a := term_of a in constr:(Product (Sine a) (Over (Cosine a)))
  | cot ?a => let a := term_of a in constr:(Product (Cosine a) (Over (Sine a)))
  | sec ?a => let a := term_of a in constr:(Over (Cosine a))
  | csc ?a => let a := term_of a in constr:(Over (Sine a))
  | ?a ^ ?n => let a := term_of a in constr:(Power a n)
  end.
Ltac steps_of c :=
  lazymatch c with
  | [] => constr:(@nil step)
  | Rot ?a ?e :: ?r => let t := term_of e in let r := steps_of r in constr:(Turn a t :: r)
  | Tr ?a ?e :: ?r => let t := term_of e in let r := steps_of r in constr:(Shift a t :: r)
  end.
Ltac terms_of v :=
  lazymatch v with V ?a ?b ?c => let a := term_of a in let b := term_of b in let c := term_of c in constr:((a, b, c)) end.
(* Decides a goal about what is shown at numbers. *)
Ltac by_numbers :=
  cbv [app back rev map opposite];
  lazymatch goal with
  | |- rounded_to (less (shown ?k ?c ?p) (shown _ ?d ?q)) ?n ?w =>
    let c := steps_of c in let d := steps_of d in let p := terms_of p in let q := terms_of q in
    let n := terms_of n in let w := terms_of w in refine (change_holds k c d p q n w _); vm_compute; reflexivity
  | |- ~ rounded_to (less (shown ?k ?c ?p) (shown _ ?d ?q)) ?n ?w =>
    let c := steps_of c in let d := steps_of d in let p := terms_of p in let q := terms_of q in
    let n := terms_of n in let w := terms_of w in refine (change_differs k c d p q n w _); vm_compute; reflexivity
  | |- rounded_to (shown ?k ?c ?p) ?n ?w =>
    let c := steps_of c in let p := terms_of p in
    let n := terms_of n in let w := terms_of w in refine (shown_holds k c p n w _); vm_compute; reflexivity
  | |- ~ rounded_to (shown ?k ?c ?p) ?n ?w =>
    let c := steps_of c in let p := terms_of p in
    let n := terms_of n in let w := terms_of w in refine (shown_differs k c p n w _); vm_compute; reflexivity
  end.
