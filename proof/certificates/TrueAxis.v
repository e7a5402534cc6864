(* TrueAxis.v: what a chain of bodies means, over the real numbers of Coq's standard library.

   The fixed library of every certificate that trueaxis writes. Parts 1 and 2 are definitions, to be read: a certificate
   says what they say. Parts 3 to 6 are proofs, which Coq checks: nobody has to read them. *)

From Coq Require Export Reals List Lra.
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
