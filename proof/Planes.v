(** Values as planes over the screen, set up in f64 and evaluated in f32: crates/tiles/src/frames/planes.rs. The error of a
    plane at a pixel, for the rounding of both formats. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa.
From Rasterproof Require Import Rounding Nearest PlaneModel.
Open Scope Q_scope.

(** ** In f64: an error of n roundings of numbers of at most R, and what lies below the normal numbers *)

Definition near (n : nat) (t R x x' : Q) : Prop := Qabs (x' - x) <= drift n * R + t /\ Qabs x <= R /\ 0 <= t.

Lemma near_size n t R x x' : near n t R x x' -> 0 <= R /\ Qabs x' <= R + drift n * R + t.
Proof.
  intros (E & S & T). pose proof (Qabs_nonneg x). split; [lra|].
  setoid_replace x' with (x + (x' - x)) by ring. pose proof (Qabs_triangle x (x' - x)). lra.
Qed.

Lemma drift_next n : (n <= 20)%nat -> drift n + u * (1 + drift n) <= drift (S n).
Proof.
  intros H. assert (L : drift n <= 1 # 2 ^ 45).
  { apply Qle_trans with (drift 20); [|apply Qle_bool_iff; vm_compute; reflexivity].
    unfold drift. apply Qmult_le_compat_r; [rewrite <- Zle_Qle; lia | discriminate]. }
  unfold drift in *. rewrite Nat2Z.inj_succ. unfold Z.succ. rewrite inject_Z_plus. change (inject_Z 1) with 1.
  setoid_replace ((inject_Z (Z.of_nat n) + 1) * rate) with (inject_Z (Z.of_nat n) * rate + rate) by ring.
  set (d := inject_Z (Z.of_nat n) * rate) in *. clearbody d.
  change (1 # 2 ^ 45) with (1 # 35184372088832) in L. unfold u, rate. lra.
Qed.

Lemma drift_positive n : 0 <= drift n.
Proof. unfold drift. apply Qmult_le_0_compat; [change 0 with (inject_Z 0); rewrite <- Zle_Qle; lia | discriminate]. Qed.

Lemma near_round n t R x x' : (n <= 20)%nat -> near n t R x x' -> near (S n) (2 * t + eta) R x (fl x').
Proof.
  intros Hn H. destruct (near_size _ _ _ _ _ H) as [R0 Z0]. destruct H as (E & B & T).
  pose proof (fl_absolute fl nearest_rounds x') as A. pose proof (drift_next n Hn) as D.
  assert (0 <= eta) by discriminate. split; [|split; lra].
  setoid_replace (fl x' - x) with (fl x' - x' + (x' - x)) by ring. pose proof (Qabs_triangle (fl x' - x') (x' - x)).
  assert (U : u * Qabs x' <= u * (R + drift n * R + t)).
  { rewrite !(Qmult_comm u). apply Qmult_le_compat_r; [assumption | discriminate]. }
  assert (M : (drift n + u * (1 + drift n)) * R <= drift (S n) * R) by (apply Qmult_le_compat_r; assumption).
  assert (V : u * t <= t) by (unfold u; lra).
  setoid_replace (u * (R + drift n * R + t)) with (u * (1 + drift n) * R + u * t) in U by ring.
  setoid_replace ((drift n + u * (1 + drift n)) * R) with (drift n * R + u * (1 + drift n) * R) in M by ring. lra.
Qed.

Lemma near_scale n t R x x' c C : Qabs c <= C -> near n t R x x' -> near n (t * C) (R * C) (x * c) (x' * c).
Proof.
  intros HC H. destruct (near_size _ _ _ _ _ H) as [R0 _]. destruct H as (E & B & T). pose proof (Qabs_nonneg c).
  pose proof (Qabs_nonneg (x' - x)). pose proof (drift_positive n). repeat split.
  - setoid_replace (x' * c - x * c) with ((x' - x) * c) by ring. rewrite Qabs_Qmult.
    assert (Z : 0 <= drift n * R + t) by lra.
    apply Qle_trans with ((drift n * R + t) * Qabs c); [apply Qmult_le_compat_r; assumption|].
    setoid_replace (drift n * (R * C) + t * C) with ((drift n * R + t) * C) by ring.
    rewrite !(Qmult_comm (drift n * R + t)). apply Qmult_le_compat_r; assumption.
  - rewrite Qabs_Qmult. apply Qle_trans with (R * Qabs c); [apply Qmult_le_compat_r; assumption|].
    rewrite !(Qmult_comm R). apply Qmult_le_compat_r; assumption.
  - apply Qmult_le_0_compat; lra.
Qed.

Lemma near_weaken n m t R x x' : (n <= m)%nat -> near n t R x x' -> near m t R x x'.
Proof.
  intros Hn H. destruct (near_size _ _ _ _ _ H) as [R0 _]. destruct H as (E & B & T). repeat split; [|assumption..].
  assert (D : drift n * R <= drift m * R).
  { apply Qmult_le_compat_r; [|assumption]. unfold drift. apply Qmult_le_compat_r; [rewrite <- Zle_Qle; lia | discriminate]. }
  lra.
Qed.

Lemma near_add n t R x x' s P y y' : near n t R x x' -> near n s P y y' -> near n (t + s) (R + P) (x + y) (x' + y').
Proof.
  intros (E & B & T) (F & C & S). repeat split; [| |lra].
  - setoid_replace (x' + y' - (x + y)) with ((x' - x) + (y' - y)) by ring. pose proof (Qabs_triangle (x' - x) (y' - y)). lra.
  - pose proof (Qabs_triangle x y). lra.
Qed.

Lemma near_opp n t R x x' : near n t R x x' -> near n t R (- x) (- x').
Proof.
  intros (E & B & T). repeat split; [| |assumption].
  - setoid_replace (- x' - - x) with (- (x' - x)) by ring. rewrite Qabs_opp. assumption.
  - rewrite Qabs_opp. assumption.
Qed.

(** A product with a number that was rounded once. *)
Lemma near_by_rounded n t R x x' p p' P : (n <= 20)%nat -> Qabs (p' - p) <= u * Qabs p -> Qabs p <= P ->
  near n t R x x' -> near (S n) (2 * (t * P)) (R * P) (x * p) (x' * p').
Proof.
  intros Hn Hp HP H. pose proof (near_scale n t R x x' p P HP H) as (E & B & T).
  destruct (near_size _ _ _ _ _ (near_scale n t R x x' p P HP H)) as [R0 Z0]. pose proof (drift_next n Hn) as D.
  repeat split; [|assumption|lra]. pose proof (Qabs_nonneg x').
  setoid_replace (x' * p' - x * p) with (x' * (p' - p) + (x' * p - x * p)) by ring.
  pose proof (Qabs_triangle (x' * (p' - p)) (x' * p - x * p)) as Tr. rewrite (Qabs_Qmult x' (p' - p)) in Tr.
  assert (U : Qabs x' * Qabs (p' - p) <= u * Qabs (x' * p)).
  { rewrite Qabs_Qmult. setoid_replace (u * (Qabs x' * Qabs p)) with (Qabs x' * (u * Qabs p)) by ring.
    rewrite !(Qmult_comm (Qabs x')). apply Qmult_le_compat_r; assumption. }
  assert (V : u * Qabs (x' * p) <= u * (R * P + drift n * (R * P) + t * P)).
  { rewrite !(Qmult_comm u). apply Qmult_le_compat_r; [assumption | discriminate]. }
  assert (M : (drift n + u * (1 + drift n)) * (R * P) <= drift (S n) * (R * P)) by (apply Qmult_le_compat_r; assumption).
  assert (Z : u * (t * P) <= t * P) by (unfold u; lra).
  setoid_replace (u * (R * P + drift n * (R * P) + t * P)) with (u * (1 + drift n) * (R * P) + u * (t * P)) in V by ring.
  setoid_replace ((drift n + u * (1 + drift n)) * (R * P)) with (drift n * (R * P) + u * (1 + drift n) * (R * P)) in M by ring. lra.
Qed.

(** ** The set-up: Frame::plane *)

Section Plane.
Variables (x1 y1 x2 y2 area pa X0 Y0 : Q).
(** Twice the area is exact, its reciprocal is rounded. *)
Hypothesis Pa : Qabs (pa - 1 / area) <= u * Qabs (1 / area).
Variables (v0 v1 v2 c0 c1 c2 M t : Q).
(** What comes in is off by two roundings. *)
Hypothesis (N0 : near 2 t M v0 c0) (N1 : near 2 t M v1 c1) (N2 : near 2 t M v2 c2).

Notation slope := (PlaneModel.slope pa).
Notation difference := (PlaneModel.difference c0).
Notation right := (PlaneModel.right y1 y2 pa c0 c1 c2).
Notation down := (PlaneModel.down x1 x2 pa c0 c1 c2).
Notation start := (PlaneModel.start x1 y1 x2 y2 pa X0 Y0 c0 c1 c2).

Definition exact_right : Q := ((v1 - v0) * y2 - (v2 - v0) * y1) * (1 / area).
Definition exact_down : Q := ((v2 - v0) * x1 - (v1 - v0) * x2) * (1 / area).

(** The largest slopes, Gx and Gy. *)
Definition steepest (a b : Q) : Q := (2 * M * Qabs a + 2 * M * Qabs b) * Qabs (1 / area).

Lemma difference_near v c : near 2 t M v c -> near 3 (2 * (t + t) + eta) (2 * M) (v - v0) (difference c).
Proof.
  intros N. pose proof (near_round 2 _ _ _ _ ltac:(lia) (near_add 2 _ _ _ _ _ _ _ _ N (near_opp _ _ _ _ _ N0))) as D.
  destruct D as (E & B & T). unfold PlaneModel.difference. repeat split; [| |assumption].
  - setoid_replace (2 * M) with (M + M) by ring. exact E.
  - setoid_replace (2 * M) with (M + M) by ring. exact B.
Qed.

Definition slope_tiny (a b : Q) : Q :=
  let s := 2 * (t + t) + eta in
  2 * (2 * ((2 * (2 * (s * Qabs a) + eta + (2 * (s * Qabs b) + eta)) + eta) * Qabs (1 / area))) + eta.

Lemma slope_near p q p' q' a b : near 3 (2 * (t + t) + eta) (2 * M) p p' -> near 3 (2 * (t + t) + eta) (2 * M) q q' ->
  near 7 (slope_tiny a b) (steepest a b) ((p * a - q * b) * (1 / area)) (slope p' q' a b).
Proof.
  intros P Q. unfold PlaneModel.slope, steepest, slope_tiny. cbv zeta.
  pose proof (near_round 3 _ _ _ _ ltac:(lia) (near_scale 3 _ _ _ _ a (Qabs a) (Qle_refl _) P)) as A.
  pose proof (near_round 3 _ _ _ _ ltac:(lia) (near_scale 3 _ _ _ _ b (Qabs b) (Qle_refl _) Q)) as B.
  pose proof (near_round 4 _ _ _ _ ltac:(lia) (near_add 4 _ _ _ _ _ _ _ _ A (near_opp _ _ _ _ _ B))) as C.
  pose proof (near_by_rounded 5 _ _ _ _ (1 / area) pa (Qabs (1 / area)) ltac:(lia) Pa (Qle_refl _) C) as D.
  exact (near_round 6 _ _ _ _ ltac:(lia) D).
Qed.

Lemma right_near : near 7 (slope_tiny y2 y1) (steepest y2 y1) exact_right right.
Proof. apply slope_near; apply difference_near; assumption. Qed.

Lemma down_near : near 7 (slope_tiny x1 x2) (steepest x1 x2) exact_down down.
Proof. apply slope_near; apply difference_near; assumption. Qed.

(** A value, with its distance from the first corner. *)
Definition exact_value (x y : Q) : Q := v0 + (exact_right * (X0 + x) + exact_down * (Y0 + y)).

Definition start_tiny : Q :=
  2 * (t + (2 * (2 * (slope_tiny y2 y1 * Qabs X0) + eta + (2 * (slope_tiny x1 x2 * Qabs Y0) + eta)) + eta)) + eta.
Definition plane_tiny (x y : Q) : Q := start_tiny + (slope_tiny y2 y1 * Qabs x + slope_tiny x1 x2 * Qabs y).

Lemma start_near : near 10 start_tiny (M + (steepest y2 y1 * Qabs X0 + steepest x1 x2 * Qabs Y0))
  (v0 + (exact_right * X0 + exact_down * Y0)) start.
Proof.
  pose proof (near_round 7 _ _ _ _ ltac:(lia) (near_scale 7 _ _ _ _ X0 (Qabs X0) (Qle_refl _) right_near)) as A.
  pose proof (near_round 7 _ _ _ _ ltac:(lia) (near_scale 7 _ _ _ _ Y0 (Qabs Y0) (Qle_refl _) down_near)) as B.
  pose proof (near_round 8 _ _ _ _ ltac:(lia) (near_add 8 _ _ _ _ _ _ _ _ A B)) as C.
  exact (near_round 9 _ _ _ _ ltac:(lia) (near_add 9 _ _ _ _ _ _ _ _ (near_weaken 2 9 _ _ _ _ ltac:(lia) N0) C)).
Qed.

(** T of the bound. *)
Definition growth (x y : Q) : Q := M + (steepest y2 y1 * (Qabs X0 + Qabs x) + steepest x1 x2 * (Qabs Y0 + Qabs y)).

Lemma regrouped s r d x y v er ed X Y : s + r * x + d * y - (v + (er * (X + x) + ed * (Y + y))) ==
  s + (r * x + d * y) - (v + (er * X + ed * Y) + (er * x + ed * y)).
Proof. ring. Qed.

Lemma regrouped_growth m a b X x Y y : m + (a * (X + x) + b * (Y + y)) == m + (a * X + b * Y) + (a * x + b * y).
Proof. ring. Qed.

(** What f64 contributes: 10 roundings of T, of the 11 that the code allows. *)
Theorem setup_error x y :
  Qabs (start + right * x + down * y - exact_value x y) <= drift 10 * growth x y + plane_tiny x y.
Proof.
  pose proof (near_weaken 7 10 _ _ _ _ ltac:(lia) (near_scale 7 _ _ _ _ x (Qabs x) (Qle_refl _) right_near)) as A.
  pose proof (near_weaken 7 10 _ _ _ _ ltac:(lia) (near_scale 7 _ _ _ _ y (Qabs y) (Qle_refl _) down_near)) as B.
  destruct (near_add 10 _ _ _ _ _ _ _ _ start_near (near_add 10 _ _ _ _ _ _ _ _ A B)) as (E & _ & _).
  unfold exact_value. rewrite (Qabs_wd _ _ (regrouped start right down x y v0 exact_right exact_down X0 Y0)).
  unfold growth, plane_tiny. rewrite (regrouped_growth M (steepest y2 y1) (steepest x1 x2) (Qabs X0) (Qabs x) (Qabs Y0) (Qabs y)).
  exact E.
Qed.
End Plane.

(** ** In f32: ValuePlane::at *)

(** S of the bound, of the rounded numbers, as the code takes it. *)
Definition size (s r d x y : Q) : Q := Qabs s + Qabs (nearest32 (r * x)) + Qabs (nearest32 (d * y)).

Lemma back x : Qabs (nearest32 x - x) <= w * (1 + 2 * w) * Qabs (nearest32 x) + 2 * tiny.
Proof.
  pose proof (nearest32_near x) as N. pose proof (Qabs_nonneg (nearest32 x)).
  assert (T : Qabs x <= Qabs (nearest32 x) + Qabs (nearest32 x - x)).
  { setoid_replace x with (nearest32 x + - (nearest32 x - x)) at 1 by ring.
    pose proof (Qabs_triangle (nearest32 x) (- (nearest32 x - x))) as P. rewrite Qabs_opp in P. exact P. }
  assert (0 <= tiny) by discriminate. unfold w in *.
  set (a := Qabs (nearest32 x)) in *. set (e := Qabs (nearest32 x - x)) in *. set (b := Qabs x) in *. set (g := tiny) in *.
  clearbody a e b g. lra.
Qed.

(** A term of the plane, after both of its numbers were rounded to f32. *)
Lemma term_error d y : Qabs y <= inject_Z (2 ^ 19) -> let d' := nearest32 d in
  Qabs (nearest32 (d' * y) - d * y) <= w * (2 + 8 * w) * Qabs (nearest32 (d' * y)) + inject_Z (2 ^ 20 + 2 ^ 19) * tiny.
Proof.
  intros Hy d'. pose proof (Qabs_nonneg y) as Y0. pose proof (back (d' * y)) as B. pose proof (back d) as D. fold d' in D.
  assert (P : Qabs (d' * y - d * y) <= w * (1 + 2 * w) * Qabs (d' * y) + inject_Z (2 ^ 20) * tiny).
  { setoid_replace (d' * y - d * y) with ((d' - d) * y) by ring. rewrite !Qabs_Qmult.
    apply Qle_trans with ((w * (1 + 2 * w) * Qabs d' + 2 * tiny) * Qabs y); [apply Qmult_le_compat_r; assumption|].
    assert (Z : tiny * Qabs y <= tiny * inject_Z (2 ^ 19)).
    { rewrite !(Qmult_comm tiny). apply Qmult_le_compat_r; [assumption | discriminate]. }
    change (inject_Z (2 ^ 20)) with (2 * inject_Z (2 ^ 19)).
    setoid_replace ((w * (1 + 2 * w) * Qabs d' + 2 * tiny) * Qabs y) with
      (w * (1 + 2 * w) * (Qabs d' * Qabs y) + 2 * (tiny * Qabs y)) by ring.
    setoid_replace (2 * inject_Z (2 ^ 19) * tiny) with (2 * (tiny * inject_Z (2 ^ 19))) by ring. lra. }
  assert (T : Qabs (d' * y) <= Qabs (nearest32 (d' * y)) + Qabs (nearest32 (d' * y) - d' * y)).
  { setoid_replace (d' * y) with (nearest32 (d' * y) + - (nearest32 (d' * y) - d' * y)) at 1 by ring.
    pose proof (Qabs_triangle (nearest32 (d' * y)) (- (nearest32 (d' * y) - d' * y))) as Q. rewrite Qabs_opp in Q. exact Q. }
  setoid_replace (nearest32 (d' * y) - d * y) with (nearest32 (d' * y) - d' * y + (d' * y - d * y)) by ring.
  pose proof (Qabs_triangle (nearest32 (d' * y) - d' * y) (d' * y - d * y)). assert (G : 0 <= tiny) by discriminate.
  change (inject_Z (2 ^ 20)) with (1048576 # 1) in *. change (inject_Z (2 ^ 20 + 2 ^ 19)) with (1572864 # 1). unfold w in *.
  pose proof (Qabs_nonneg (nearest32 (d' * y))).
  set (a := Qabs (nearest32 (d' * y))) in *. set (e := Qabs (nearest32 (d' * y) - d' * y)) in *.
  set (b := Qabs (d' * y)) in *. set (g := tiny) in *. set (q := Qabs (d' * y - d * y)) in *. clearbody a e b g q. lra.
Qed.

(** What f32 contributes: 4 u S. *)
Theorem evaluation_error s r d x y : Qabs x <= inject_Z (2 ^ 19) -> Qabs y <= inject_Z (2 ^ 19) ->
  Qabs (at_pixel (nearest32 s) (nearest32 r) (nearest32 d) x y - (s + r * x + d * y)) <=
    4 * w * size (nearest32 s) (nearest32 r) (nearest32 d) x y * (1 + (1 # 2 ^ 20)) + inject_Z (2 ^ 22) * tiny.
Proof.
  intros Hx Hy. set (s' := nearest32 s). set (r' := nearest32 r). set (d' := nearest32 d). unfold at_pixel, size. pose proof (back s) as S. fold s' in S.
  pose proof (term_error r x Hx) as R. pose proof (term_error d y Hy) as D. cbv zeta in R, D. fold r' in R. fold d' in D.
  set (b := nearest32 (d' * y)) in *. set (c := nearest32 (r' * x)) in *. clearbody b c s'.
  pose proof (nearest32_near (s' + b)) as E. set (m := nearest32 (s' + b)) in *. clearbody m.
  pose proof (nearest32_near (m + c)) as F. set (o := nearest32 (m + c)) in *. clearbody o.
  pose proof (Qabs_triangle s' b) as T1. pose proof (Qabs_triangle m c) as T2.
  assert (T3 : Qabs m <= Qabs (s' + b) + Qabs (m - (s' + b))).
  { setoid_replace m with (s' + b + (m - (s' + b))) at 1 by ring. apply Qabs_triangle. }
  setoid_replace (o - (s + r * x + d * y)) with
    ((o - (m + c)) + ((m - (s' + b)) + ((s' - s) + ((c - r * x) + (b - d * y))))) by ring.
  pose proof (Qabs_triangle (o - (m + c)) ((m - (s' + b)) + ((s' - s) + ((c - r * x) + (b - d * y))))) as U1.
  pose proof (Qabs_triangle (m - (s' + b)) ((s' - s) + ((c - r * x) + (b - d * y)))) as U2.
  pose proof (Qabs_triangle (s' - s) ((c - r * x) + (b - d * y))) as U3. pose proof (Qabs_triangle (c - r * x) (b - d * y)) as U4.
  pose proof (Qabs_nonneg s'). pose proof (Qabs_nonneg b). pose proof (Qabs_nonneg c). assert (G : 0 <= tiny) by discriminate.
  change (inject_Z (2 ^ 20 + 2 ^ 19)) with (1572864 # 1) in *. change (inject_Z (2 ^ 22)) with (4194304 # 1).
  change (1 # 2 ^ 20) with (1 # 1048576). unfold w in *.
  set (as_ := Qabs s') in *. set (ab := Qabs b) in *. set (ac := Qabs c) in *. set (g := tiny) in *.
  set (e1 := Qabs (o - (m + c))) in *. set (e2 := Qabs (m - (s' + b))) in *. set (e3 := Qabs (s' - s)) in *.
  set (e4 := Qabs (c - r * x)) in *. set (e5 := Qabs (b - d * y)) in *. set (am := Qabs m) in *.
  set (a1 := Qabs (s' + b)) in *. set (a2 := Qabs (m + c)) in *.
  set (z1 := Qabs (o - (m + c) + (m - (s' + b) + (s' - s + (c - r * x + (b - d * y)))))) in *.
  set (z2 := Qabs (m - (s' + b) + (s' - s + (c - r * x + (b - d * y))))) in *.
  set (z3 := Qabs (s' - s + (c - r * x + (b - d * y)))) in *. set (z4 := Qabs (c - r * x + (b - d * y))) in *.
  clearbody as_ ab ac g e1 e2 e3 e4 e5 am a1 a2 z1 z2 z3 z4. lra.
Qed.

(** ** The bounds of the code *)

(** ValuePlane::error, with S and T, and the constants of the code. *)
Definition plane_bound (of_f32 of_f64 : positive) (second underflow : positive) (S T : Q) : Q :=
  (inject_Z (Z.pos of_f32) * w * S + inject_Z (Z.pos of_f64) * u * T) * (1 + (1 # 2 ^ second)) + (1 # 2 ^ underflow).

Lemma product_le p P q R : 0 <= p <= P -> 0 <= q <= R -> 0 <= p * q <= P * R.
Proof.
  intros [A B] [C D]. split; [apply Qmult_le_0_compat; assumption|].
  apply Qle_trans with (P * q); [apply Qmult_le_compat_r; assumption|].
  rewrite !(Qmult_comm P). apply Qmult_le_compat_r; [assumption | lra].
Qed.

Section Bound.
Variables (x1 y1 x2 y2 area pa X0 Y0 : Q).
Hypothesis Pa : Qabs (pa - 1 / area) <= u * Qabs (1 / area).
Variables (v0 v1 v2 c0 c1 c2 M t : Q).
Hypothesis (N0 : near 2 t M v0 c0) (N1 : near 2 t M v1 c1) (N2 : near 2 t M v2 c2).

(** Every triangle of the tiles: edges below 2^18 px, an area of at least one square subpixel, and what lies below the
    normal numbers of f64. *)
Hypothesis (B1 : Qabs x1 <= inject_Z (2 ^ 18)) (B2 : Qabs y1 <= inject_Z (2 ^ 18)).
Hypothesis (B3 : Qabs x2 <= inject_Z (2 ^ 18)) (B4 : Qabs y2 <= inject_Z (2 ^ 18)).
Hypothesis (BA : Qabs (1 / area) <= inject_Z (2 ^ 17)).
Hypothesis (BX : Qabs X0 <= inject_Z (2 ^ 24)) (BY : Qabs Y0 <= inject_Z (2 ^ 24)) (BT : t <= 1 # 2 ^ 900).

Lemma slope_tiny_small a b : Qabs a <= inject_Z (2 ^ 18) -> Qabs b <= inject_Z (2 ^ 18) ->
  0 <= slope_tiny area t a b <= 1 # 2 ^ 840.
Proof.
  intros A B. destruct N0 as (_ & _ & T0). unfold slope_tiny. cbv zeta. assert (E : 0 <= eta <= 1 # 2 ^ 1000)
    by (split; [discriminate | apply Qle_bool_iff; vm_compute; reflexivity]).
  assert (S : 0 <= 2 * (t + t) + eta <= 1 # 2 ^ 890).
  { assert (F : 4 * (1 # 2 ^ 900) + (1 # 2 ^ 1000) <= 1 # 2 ^ 890) by (apply Qle_bool_iff; vm_compute; reflexivity).
    set (k := 1 # 2 ^ 900) in *. set (l := 1 # 2 ^ 1000) in *. set (m := 1 # 2 ^ 890) in *. set (e := eta) in *.
    clearbody k l m e. lra. }
  pose proof (product_le _ _ _ _ S (conj (Qabs_nonneg a) A)) as PA. pose proof (product_le _ _ _ _ S (conj (Qabs_nonneg b) B)) as PB.
  set (s := 2 * (t + t) + eta) in *. clearbody s.
  assert (F1 : 2 * (2 * ((1 # 2 ^ 890) * inject_Z (2 ^ 18)) + (1 # 2 ^ 1000) + (2 * ((1 # 2 ^ 890) * inject_Z (2 ^ 18)) + (1 # 2 ^ 1000)))
    + (1 # 2 ^ 1000) <= 1 # 2 ^ 868) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (I : 0 <= 2 * (2 * (s * Qabs a) + eta + (2 * (s * Qabs b) + eta)) + eta <= 1 # 2 ^ 868).
  { set (p := s * Qabs a) in *. set (q := s * Qabs b) in *. set (k := (1 # 2 ^ 890) * inject_Z (2 ^ 18)) in *.
    set (l := 1 # 2 ^ 1000) in *. set (m := 1 # 2 ^ 868) in *. set (e := eta) in *. clearbody p q k l m e. lra. }
  pose proof (product_le _ _ _ _ I (conj (Qabs_nonneg (1 / area)) BA)) as J.
  set (i := (2 * (2 * (s * Qabs a) + eta + (2 * (s * Qabs b) + eta)) + eta) * Qabs (1 / area)) in *. clearbody i.
  assert (F2 : 4 * ((1 # 2 ^ 868) * inject_Z (2 ^ 17)) + (1 # 2 ^ 1000) <= 1 # 2 ^ 840) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (k := (1 # 2 ^ 868) * inject_Z (2 ^ 17)) in *. set (l := 1 # 2 ^ 1000) in *. set (m := 1 # 2 ^ 840) in *. set (e := eta) in *.
  clearbody k l m e. lra.
Qed.

Lemma plane_tiny_small x y : Qabs x <= inject_Z (2 ^ 19) -> Qabs y <= inject_Z (2 ^ 19) ->
  plane_tiny x1 y1 x2 y2 area X0 Y0 t x y <= 1 # 2 ^ 800.
Proof.
  intros Hx Hy. destruct N0 as (_ & _ & T0). unfold plane_tiny, start_tiny.
  pose proof (slope_tiny_small y2 y1 B4 B2) as SR. pose proof (slope_tiny_small x1 x2 B1 B3) as SD.
  set (r := slope_tiny area t y2 y1) in *. set (d := slope_tiny area t x1 x2) in *. clearbody r d.
  pose proof (product_le _ _ _ _ SR (conj (Qabs_nonneg X0) BX)). pose proof (product_le _ _ _ _ SD (conj (Qabs_nonneg Y0) BY)).
  pose proof (product_le _ _ _ _ SR (conj (Qabs_nonneg x) Hx)). pose proof (product_le _ _ _ _ SD (conj (Qabs_nonneg y) Hy)).
  assert (E : 0 <= eta <= 1 # 2 ^ 1000) by (split; [discriminate | apply Qle_bool_iff; vm_compute; reflexivity]).
  assert (F : 2 * ((1 # 2 ^ 900) + (2 * (2 * ((1 # 2 ^ 840) * inject_Z (2 ^ 24)) + (1 # 2 ^ 1000) + (2 * ((1 # 2 ^ 840) * inject_Z (2 ^ 24)) + (1 # 2 ^ 1000))) + (1 # 2 ^ 1000)))
    + (1 # 2 ^ 1000) + ((1 # 2 ^ 840) * inject_Z (2 ^ 19) + (1 # 2 ^ 840) * inject_Z (2 ^ 19)) <= 1 # 2 ^ 800)
    by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (k := (1 # 2 ^ 840) * inject_Z (2 ^ 24)) in *. set (l := (1 # 2 ^ 840) * inject_Z (2 ^ 19)) in *.
  set (p := r * Qabs X0) in *. set (q := d * Qabs Y0) in *. set (a := r * Qabs x) in *. set (b := d * Qabs y) in *.
  set (m := 1 # 2 ^ 800) in *. set (n := 1 # 2 ^ 900) in *. set (o := 1 # 2 ^ 1000) in *. set (e := eta) in *.
  clearbody k l p q a b m n o e. lra.
Qed.

Notation started := (PlaneModel.start x1 y1 x2 y2 pa X0 Y0 c0 c1 c2).
Notation rightwards := (PlaneModel.right y1 y2 pa c0 c1 c2).
Notation downwards := (PlaneModel.down x1 x2 pa c0 c1 c2).

Lemma ten_of_eleven : drift 10 * (1 + (1 # 2 ^ 30)) <= 11 * u.
Proof. apply Qle_bool_iff. vm_compute. reflexivity. Qed.

Lemma scaled_growth g T m : g <= T * (1 + (1 # 2 ^ 30)) + m -> 0 <= T -> 0 <= m -> drift 10 * g <= 11 * u * T + m.
Proof.
  intros HT Tp Mp. pose proof ten_of_eleven as D. pose proof (drift_positive 10) as D0.
  assert (D1 : drift 10 <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (ten := drift 10) in *. set (more := 1 + (1 # 2 ^ 30)) in *. set (eleven := 11 * u) in *. clearbody ten more eleven.
  apply Qle_trans with (ten * (T * more + m)).
  - rewrite !(Qmult_comm ten). apply Qmult_le_compat_r; assumption.
  - setoid_replace (ten * (T * more + m)) with (ten * more * T + ten * m) by ring.
    assert (ten * more * T <= eleven * T) by (apply Qmult_le_compat_r; assumption).
    assert (ten * m <= 1 * m) by (apply Qmult_le_compat_r; assumption). lra.
Qed.

Lemma all_tiny : inject_Z (2 ^ 22) * tiny + ((1 # 2 ^ 800) + (1 # 2 ^ 800)) <= 1 # 2 ^ 127.
Proof. apply Qle_bool_iff. vm_compute. reflexivity. Qed.

Lemma bounded e1 e2 e3 tg tt k l n m T (size_ : Q) : e3 <= e1 + e2 -> e1 <= 4 * w * size_ * (1 + (1 # 2 ^ 20)) + k ->
  e2 <= tg + tt -> tt <= l -> tg <= 11 * u * T + n -> k + (l + n) <= m -> 0 <= size_ -> 0 <= T ->
  e3 <= (4 * w * size_ + 11 * u * T) * (1 + (1 # 2 ^ 20)) + m.
Proof.
  intros. change (1 # 2 ^ 20) with (1 # 1048576) in *. unfold w, u in *. lra.
Qed.

(** A plane at a pixel, or at a sample beside it. T is computed by the code, so it may be off by a few roundings:
    [TilePlanes] proves by how many. *)
Theorem plane_error x y T : Qabs x <= inject_Z (2 ^ 19) -> Qabs y <= inject_Z (2 ^ 19) -> 0 <= T ->
  growth x1 y1 x2 y2 area X0 Y0 M x y <= T * (1 + (1 # 2 ^ 30)) + (1 # 2 ^ 800) ->
  Qabs (at_pixel (nearest32 started) (nearest32 rightwards) (nearest32 downwards) x y -
        exact_value x1 y1 x2 y2 area X0 Y0 v0 v1 v2 x y) <=
    plane_bound 4 11 20 127 (size (nearest32 started) (nearest32 rightwards) (nearest32 downwards) x y) T.
Proof.
  intros Ax Ay Tp HT. pose proof (evaluation_error started rightwards downwards x y Ax Ay) as E.
  pose proof (setup_error x1 y1 x2 y2 area pa X0 Y0 Pa v0 v1 v2 c0 c1 c2 M t N0 N1 N2 x y) as F.
  pose proof (plane_tiny_small x y Ax Ay) as P.
  pose proof (scaled_growth _ T _ HT Tp ltac:(discriminate)) as K.
  assert (S0 : 0 <= size (nearest32 started) (nearest32 rightwards) (nearest32 downwards) x y).
  { unfold size. pose proof (fun a => Qabs_nonneg a) as N. apply (Qle_trans _ (0 + 0 + 0)); [discriminate | repeat apply Qplus_le_compat; apply N]. }
  assert (H : forall o v sum, Qabs (o - v) <= Qabs (o - sum) + Qabs (sum - v)).
  { intros o v sum. setoid_replace (o - v) with (o - sum + (sum - v)) by ring. apply Qabs_triangle. }
  exact (bounded _ _ _ _ _ _ _ _ _ _ _ (H _ _ _) E F P K all_tiny S0 Tp).
Qed.

(** ** Nothing overflows in f32: S is at most 2^64 M, and what fits where S is below 2^127 *)

Lemma twice32 z : Qabs (nearest32 z) <= 2 * Qabs z + (1 # 2 ^ 100).
Proof.
  pose proof (nearest32_near z) as N. pose proof (Qabs_triangle z (nearest32 z - z)) as T.
  setoid_replace (z + (nearest32 z - z)) with (nearest32 z) in T by ring. pose proof (Qabs_nonneg z).
  assert (F : tiny <= 1 # 2 ^ 100) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (g := tiny) in *. set (h := 1 # 2 ^ 100) in *. clearbody g h. unfold w in N. lra.
Qed.

Lemma steepest_at_most a b : Qabs a <= inject_Z (2 ^ 18) -> Qabs b <= inject_Z (2 ^ 18) ->
  0 <= steepest area M a b <= M * inject_Z (2 ^ 37).
Proof.
  intros A B. destruct (near_size _ _ _ _ _ N0) as [M0 _]. pose proof (Qabs_nonneg a). pose proof (Qabs_nonneg b). unfold steepest.
  assert (S : 0 <= Qabs a + Qabs b <= inject_Z (2 ^ 19)).
  { change (inject_Z (2 ^ 19)) with (524288 # 1). change (inject_Z (2 ^ 18)) with (262144 # 1) in *. lra. }
  pose proof (product_le _ _ _ _ S (conj (Qabs_nonneg (1 / area)) BA)) as P.
  assert (M2 : 0 <= 2 * M <= 2 * M) by lra. pose proof (product_le _ _ _ _ M2 P) as R.
  setoid_replace ((2 * M * Qabs a + 2 * M * Qabs b) * Qabs (1 / area)) with (2 * M * ((Qabs a + Qabs b) * Qabs (1 / area))) by ring.
  assert (E : 2 * M * (inject_Z (2 ^ 19) * inject_Z (2 ^ 17)) == M * inject_Z (2 ^ 37)).
  { change (inject_Z (2 ^ 37)) with (2 * (inject_Z (2 ^ 19) * inject_Z (2 ^ 17))). ring. }
  rewrite E in R. exact R.
Qed.

Lemma rounded_at_most n t' R x x' B : (n <= 20)%nat -> near n t' R x x' -> t' <= 1 # 2 ^ 100 -> R <= B ->
  Qabs (nearest32 x') <= (2 + (1 # 1048576)) * B + 4 * (1 # 2 ^ 100).
Proof.
  intros Hn N T RB. destruct (near_size _ _ _ _ _ N) as [R0 S]. pose proof (twice32 x') as H.
  assert (D : drift n <= 1 # 2 ^ 45).
  { apply Qle_trans with (drift 20); [|apply Qle_bool_iff; vm_compute; reflexivity].
    unfold drift. apply Qmult_le_compat_r; [rewrite <- Zle_Qle; lia | discriminate]. }
  assert (E : drift n * R <= (1 # 2 ^ 45) * R) by (apply Qmult_le_compat_r; assumption).
  assert (H0 : 0 <= 1 # 2 ^ 100) by discriminate.
  set (h := 1 # 2 ^ 100) in *. set (d := drift n * R) in *. clearbody h d. change (1 # 2 ^ 45) with (1 # 35184372088832) in E. lra.
Qed.

Lemma product32_at_most d B x : Qabs d <= B -> Qabs x <= inject_Z (2 ^ 19) ->
  Qabs (nearest32 (d * x)) <= 2 * (B * inject_Z (2 ^ 19)) + (1 # 2 ^ 100).
Proof.
  intros Hd Hx. pose proof (twice32 (d * x)) as H. rewrite Qabs_Qmult in H.
  pose proof (product_le _ _ _ _ (conj (Qabs_nonneg d) Hd) (conj (Qabs_nonneg x) Hx)) as P. lra.
Qed.

Theorem size_at_most x y : Qabs x <= inject_Z (2 ^ 19) -> Qabs y <= inject_Z (2 ^ 19) ->
  size (nearest32 started) (nearest32 rightwards) (nearest32 downwards) x y <= inject_Z (2 ^ 64) * M + 1.
Proof.
  intros Hx Hy. destruct (near_size _ _ _ _ _ N0) as [M0 _]. unfold size.
  pose proof (steepest_at_most y2 y1 B4 B2) as SR. pose proof (steepest_at_most x1 x2 B1 B3) as SD.
  pose proof (slope_tiny_small y2 y1 B4 B2) as [_ TR]. pose proof (slope_tiny_small x1 x2 B1 B3) as [_ TD].
  assert (F1 : 1 # 2 ^ 840 <= 1 # 2 ^ 100) by discriminate. assert (F2 : 1 # 2 ^ 800 <= 1 # 2 ^ 100) by discriminate.
  pose proof (right_near y1 y2 area pa Pa v0 v1 v2 c0 c1 c2 M t N0 N1 N2) as NR.
  pose proof (down_near x1 x2 area pa Pa v0 v1 v2 c0 c1 c2 M t N0 N1 N2) as ND.
  pose proof (start_near x1 y1 x2 y2 area pa X0 Y0 Pa v0 v1 v2 c0 c1 c2 M t N0 N1 N2) as NS.
  pose proof (rounded_at_most 7 _ _ _ _ _ ltac:(lia) NR (Qle_trans _ _ _ TR F1) (proj2 SR)) as R.
  pose proof (rounded_at_most 7 _ _ _ _ _ ltac:(lia) ND (Qle_trans _ _ _ TD F1) (proj2 SD)) as D.
  assert (TS : start_tiny x1 y1 x2 y2 area X0 Y0 t <= 1 # 2 ^ 100).
  { apply (Qle_trans _ (1 # 2 ^ 800)); [|exact F2]. pose proof (plane_tiny_small 0 0 ltac:(discriminate) ltac:(discriminate)) as P.
    unfold plane_tiny in P. change (Qabs 0) with 0 in P. rewrite !Qmult_0_r in P. rewrite Qplus_0_r, Qplus_0_r in P. exact P. }
  assert (BS : M + (steepest area M y2 y1 * Qabs X0 + steepest area M x1 x2 * Qabs Y0) <=
    M + (M * inject_Z (2 ^ 37) * inject_Z (2 ^ 24) + M * inject_Z (2 ^ 37) * inject_Z (2 ^ 24))).
  { pose proof (product_le _ _ _ _ SR (conj (Qabs_nonneg X0) BX)). pose proof (product_le _ _ _ _ SD (conj (Qabs_nonneg Y0) BY)). lra. }
  pose proof (rounded_at_most 10 _ _ _ _ _ ltac:(lia) NS TS BS) as S.
  pose proof (product32_at_most _ _ x R Hx) as PR. pose proof (product32_at_most _ _ y D Hy) as PD.
  set (a := Qabs (nearest32 started)) in *. set (b := Qabs (nearest32 (nearest32 rightwards * x))) in *.
  set (c := Qabs (nearest32 (nearest32 downwards * y))) in *. clearbody a b c.
  assert (H : (1 # 2 ^ 100) <= 1 # 1267650600228229401496703205376) by discriminate. set (h := 1 # 2 ^ 100) in *. clearbody h.
  change (inject_Z (2 ^ 37)) with (137438953472 # 1) in *. change (inject_Z (2 ^ 24)) with (16777216 # 1) in *.
  change (inject_Z (2 ^ 19)) with (524288 # 1) in *. change (inject_Z (2 ^ 64)) with (18446744073709551616 # 1).
  clear - M0 S PR PD H. lra.
Qed.
End Bound.

(** The largest number of f32. *)
Definition largest32 : Q := Eval compute in inject_Z (2 ^ 128 - 2 ^ 104).

(** Where S, of exact sums, is below 2^127 and a little, no product and no sum of the plane leaves f32. *)
Theorem plane_fits s r d x y : size s r d x y <= inject_Z (2 ^ 127 + 2 ^ 100) ->
  Qabs s <= largest32 /\ Qabs (nearest32 (r * x)) <= largest32 /\ Qabs (nearest32 (d * y)) <= largest32 /\
  Qabs (nearest32 (s + nearest32 (d * y))) <= largest32 /\ Qabs (at_pixel s r d x y) <= largest32.
Proof.
  unfold size, at_pixel. intros H. set (b := nearest32 (d * y)) in *. set (c := nearest32 (r * x)) in *.
  pose proof (Qabs_nonneg s). pose proof (Qabs_nonneg b). pose proof (Qabs_nonneg c).
  pose proof (nearest32_near (s + b)) as E. set (m := nearest32 (s + b)) in *. pose proof (nearest32_near (m + c)) as F.
  set (o := nearest32 (m + c)) in *. pose proof (Qabs_triangle s b). pose proof (Qabs_triangle m c).
  pose proof (Qabs_triangle (s + b) (m - (s + b))) as T1. setoid_replace (s + b + (m - (s + b))) with m in T1 by ring.
  pose proof (Qabs_triangle (m + c) (o - (m + c))) as T2. setoid_replace (m + c + (o - (m + c))) with o in T2 by ring.
  assert (L : inject_Z (2 ^ 127 + 2 ^ 100) * (1 + (1 # 4194304)) + 1 <= largest32) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (P : inject_Z (2 ^ 127 + 2 ^ 100) <= largest32) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (G : tiny <= 1 # 1048576) by discriminate.
  set (k := inject_Z (2 ^ 127 + 2 ^ 100)) in *. set (l := largest32) in *. set (g := tiny) in *. clearbody k l g.
  set (e1 := Qabs (m - (s + b))) in *. set (e2 := Qabs (o - (m + c))) in *. set (z1 := Qabs (s + b)) in *. set (z2 := Qabs (m + c)) in *.
  set (as_ := Qabs s) in *. set (ab := Qabs b) in *. set (ac := Qabs c) in *. set (am := Qabs m) in *. set (ao := Qabs o) in *.
  clearbody e1 e2 z1 z2 as_ ab ac am ao. unfold w in *. repeat split; lra.
Qed.

(** A plane is at most four times S. *)
Lemma plane_at_most s r d x y : Qabs (at_pixel s r d x y) <= 4 * size s r d x y + 1.
Proof.
  unfold size, at_pixel. set (b := nearest32 (d * y)) in *. set (c := nearest32 (r * x)) in *.
  pose proof (twice32 (s + b)) as E. set (m := nearest32 (s + b)) in *. pose proof (twice32 (m + c)) as F.
  pose proof (Qabs_triangle s b). pose proof (Qabs_triangle m c). pose proof (Qabs_nonneg c). assert (G : 1 # 2 ^ 100 <= 1 # 1024) by discriminate.
  set (h := 1 # 2 ^ 100) in *. clearbody h. lra.
Qed.

(** Bounded::value: an attribute is the quotient of its plane and that of 1/w, taken with a rounded reciprocal. *)
Definition quotient_bound (of_rounding : positive) (second underflow : positive) (en eq n' q' : Q) : Q :=
  ((en + Qabs (n' / q') * eq) / (q' - eq) + inject_Z (Z.pos of_rounding) * w * Qabs (n' / q')) * (1 + (1 # 2 ^ second)) +
    (1 # 2 ^ underflow).

Lemma quotient_of_errors n q n' q' en eq : Qabs (n' - n) <= en -> Qabs (q' - q) <= eq -> eq < q' ->
  Qabs (n' / q' - n / q) <= (en + Qabs (n' / q') * eq) / (q' - eq).
Proof.
  intros En Eq P. pose proof (Qabs_nonneg (q' - q)) as E0. pose proof (proj1 (Qabs_Qle_condition _ _) Eq) as B.
  assert (Q0 : 0 < q) by lra. assert (Q1 : 0 < q') by lra. assert (Q2 : 0 < q' - eq) by lra.
  assert (I : n' / q' - n / q == (n' - n + (n' / q') * - (q' - q)) / q) by (field; split; lra).
  rewrite (Qabs_wd _ _ I). unfold Qdiv at 1. rewrite Qabs_Qmult, Qabs_Qinv, (Qabs_pos q) by lra.
  pose proof (Qabs_triangle (n' - n) ((n' / q') * - (q' - q))) as T. rewrite Qabs_Qmult, Qabs_opp in T.
  pose proof (Qabs_nonneg (n' / q')) as A0. set (a := Qabs (n' / q')) in *.
  assert (M : a * Qabs (q' - q) <= a * eq) by (rewrite !(Qmult_comm a); apply Qmult_le_compat_r; assumption).
  set (z := Qabs (n' - n + n' / q' * - (q' - q))) in *. assert (Z : z <= en + a * eq) by lra.
  assert (Z0 : 0 <= z) by apply Qabs_nonneg.
  apply Qle_shift_div_l; [assumption|]. setoid_replace (z * / q * (q' - eq)) with (z * (q' - eq) / q) by (unfold Qdiv; ring).
  apply Qle_shift_div_r; [assumption|]. apply Qle_trans with (z * q).
  - rewrite !(Qmult_comm z). apply Qmult_le_compat_r; lra.
  - apply Qmult_le_compat_r; lra.
Qed.

Lemma reciprocal_error q' : 0 < q' -> q' <= inject_Z (2 ^ 80) ->
  Qabs (nearest32 (1 / q') - 1 / q') <= w * (1 + (1 # 2 ^ 40)) * (1 / q').
Proof.
  intros Q1 Most. pose proof (nearest32_near (1 / q')) as R.
  assert (Hh : 1 # 2 ^ 80 <= 1 / q').
  { apply Qle_shift_div_l; [assumption|]. apply Qle_trans with ((1 # 2 ^ 80) * inject_Z (2 ^ 80)); [|discriminate].
    rewrite !(Qmult_comm (1 # 2 ^ 80)). apply Qmult_le_compat_r; [assumption | discriminate]. }
  assert (H0 : 0 <= 1 / q') by (apply Qle_trans with (1 # 2 ^ 80); [discriminate | assumption]).
  rewrite (Qabs_pos (1 / q')) in R by assumption.
  assert (T : tiny <= w * (1 # 2 ^ 40) * (1 # 2 ^ 80)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (M : w * (1 # 2 ^ 40) * (1 # 2 ^ 80) <= w * (1 # 2 ^ 40) * (1 / q')).
  { rewrite !(Qmult_comm (w * (1 # 2 ^ 40))). apply Qmult_le_compat_r; [assumption | discriminate]. }
  set (i := 1 / q') in *. setoid_replace (w * (1 + (1 # 2 ^ 40)) * i) with (w * i + w * (1 # 2 ^ 40) * i) by ring.
  set (k := w * (1 # 2 ^ 40) * i) in *. set (l := w * (1 # 2 ^ 40) * (1 # 2 ^ 80)) in *. clearbody k l. lra.
Qed.

Lemma product_error n' q' : 0 < q' -> Qabs (nearest32 (1 / q') - 1 / q') <= w * (1 + (1 # 2 ^ 40)) * (1 / q') ->
  Qabs (n' * nearest32 (1 / q') - n' / q') <= w * (1 + (1 # 2 ^ 40)) * Qabs (n' / q').
Proof.
  intros Q1 R1. assert (H0 : 0 <= 1 / q') by (apply Qle_shift_div_l; lra). set (p := nearest32 (1 / q')) in *. clearbody p.
  setoid_replace (n' * p - n' / q') with (n' * (p - 1 / q')) by (field; lra).
  assert (A : Qabs (n' / q') == Qabs n' * (1 / q')).
  { setoid_replace (n' / q') with (n' * (1 / q')) by (field; lra). rewrite Qabs_Qmult, (Qabs_pos (1 / q')) by assumption. reflexivity. }
  rewrite A, Qabs_Qmult. setoid_replace (w * (1 + (1 # 2 ^ 40)) * (Qabs n' * (1 / q'))) with (Qabs n' * (w * (1 + (1 # 2 ^ 40)) * (1 / q'))) by ring.
  rewrite !(Qmult_comm (Qabs n')). apply Qmult_le_compat_r; [assumption | apply Qabs_nonneg].
Qed.

Theorem quotient_error n q n' q' en eq : Qabs (n' - n) <= en -> Qabs (q' - q) <= eq -> eq < q' -> q' <= inject_Z (2 ^ 80) ->
  Qabs (nearest32 (n' * nearest32 (1 / q')) - n / q) <= quotient_bound 2 20 130 en eq n' q'.
Proof.
  intros En Eq P Most. pose proof (quotient_of_errors n q n' q' en eq En Eq P) as F. unfold quotient_bound.
  pose proof (Qabs_nonneg (q' - q)). assert (Q1 : 0 < q') by lra.
  pose proof (nearest32_near (n' * nearest32 (1 / q'))) as G.
  pose proof (product_error n' q' Q1 (reciprocal_error q' Q1 Most)) as N. set (p := nearest32 (1 / q')) in *. clearbody p.
  assert (S : Qabs (n' * p) <= Qabs (n' / q') + Qabs (n' * p - n' / q')).
  { setoid_replace (n' * p) with (n' / q' + (n' * p - n' / q')) at 1 by ring. apply Qabs_triangle. }
  set (o := nearest32 (n' * p)) in *. clearbody o.
  setoid_replace (o - n / q) with ((o - n' * p) + ((n' * p - n' / q') + (n' / q' - n / q))) by ring.
  pose proof (Qabs_triangle (o - n' * p) ((n' * p - n' / q') + (n' / q' - n / q))) as T1.
  pose proof (Qabs_triangle (n' * p - n' / q') (n' / q' - n / q)) as T2.
  pose proof (Qabs_nonneg (n' / q')) as A0. pose proof (Qabs_nonneg (n' / q' - n / q)) as A1.
  assert (T : tiny <= 1 # 2 ^ 130) by discriminate.
  set (a := Qabs (n' / q')) in *. set (off := (en + a * eq) / (q' - eq)) in *. set (m := 1 # 2 ^ 130) in *. set (g := tiny) in *.
  change (inject_Z 2) with 2. change (1 # 2 ^ 40) with (1 # 1099511627776) in *. change (1 # 2 ^ 20) with (1 # 1048576).
  set (e1 := Qabs (o - n' * p)) in *. set (e2 := Qabs (n' * p - n' / q')) in *. set (e3 := Qabs (n' / q' - n / q)) in *.
  set (b := Qabs (n' * p)) in *. set (z := Qabs (o - n' * p + (n' * p - n' / q' + (n' / q' - n / q)))) in *.
  set (y := Qabs (n' * p - n' / q' + (n' / q' - n / q))) in *. clearbody a off m g e1 e2 e3 b z y. unfold w in *. lra.
Qed.

(** The reciprocal of q and the quotient fit where q is not below 2^-127 and the quotient is below 2^127. *)
Theorem quotient_fits n q : 1 # 2 ^ 127 <= q -> q <= inject_Z (2 ^ 80) -> Qabs (n / q) <= inject_Z (2 ^ 127 + 2 ^ 100) ->
  Qabs (nearest32 (1 / q)) <= largest32 /\ Qabs (computed_quotient n q) <= largest32.
Proof.
  intros L U B. assert (Q0 : 0 < q) by (apply (Qlt_le_trans _ (1 # 2 ^ 127)); [reflexivity | assumption]).
  assert (I0 : 0 <= 1 / q) by (apply Qle_shift_div_l; lra).
  assert (I1 : 1 / q <= inject_Z (2 ^ 127)).
  { apply Qle_shift_div_r; [assumption|]. apply Qle_trans with (inject_Z (2 ^ 127) * (1 # 2 ^ 127)); [apply Qle_bool_iff; vm_compute; reflexivity|].
    rewrite !(Qmult_comm (inject_Z (2 ^ 127))). apply Qmult_le_compat_r; [assumption | discriminate]. }
  pose proof (reciprocal_error q Q0 U) as R. set (p := nearest32 (1 / q)) in *.
  pose proof (Qabs_triangle (1 / q) (p - 1 / q)) as T. setoid_replace (1 / q + (p - 1 / q)) with p in T by ring.
  rewrite (Qabs_pos (1 / q)) in T by assumption. pose proof (product_error n q Q0 R) as N. fold p in N. unfold computed_quotient. fold p.
  pose proof (Qabs_triangle (n / q) (n * p - n / q)) as T2. setoid_replace (n / q + (n * p - n / q)) with (n * p) in T2 by ring.
  pose proof (nearest32_near (n * p)) as F. pose proof (Qabs_triangle (n * p) (nearest32 (n * p) - n * p)) as T3.
  setoid_replace (n * p + (nearest32 (n * p) - n * p)) with (nearest32 (n * p)) in T3 by ring.
  assert (C1 : inject_Z (2 ^ 127) * (1 + (1 # 4194304)) <= largest32) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (C2 : inject_Z (2 ^ 127 + 2 ^ 100) * (1 + (1 # 4194304)) + 1 <= largest32) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (G : tiny <= 1 # 1048576) by discriminate. pose proof (Qabs_nonneg (n / q)).
  set (k := inject_Z (2 ^ 127)) in *. set (k1 := inject_Z (2 ^ 127 + 2 ^ 100)) in *. set (l := largest32) in *. set (g := tiny) in *.
  clearbody k k1 l g. set (i := 1 / q) in *. set (a := Qabs (n / q)) in *. set (e1 := Qabs (p - i)) in *. set (e2 := Qabs (n * p - n / q)) in *.
  set (o := Qabs (nearest32 (n * p))) in *. set (e3 := Qabs (nearest32 (n * p) - n * p)) in *. set (m := Qabs (n * p)) in *.
  set (ap := Qabs p) in *. clearbody i a e1 e2 o e3 m ap. change (1 # 2 ^ 40) with (1 # 1099511627776) in *. unfold w in *. split; lra.
Qed.
