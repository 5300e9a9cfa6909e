(** Rounding to nearest as f64 does it, over the rationals: what one operation may be off by, and how the errors of
    positive numbers add up. Nothing here rests on an axiom: doubles, their sums, products and quotients are rational. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa Bool Arith List.
Import ListNotations.
Open Scope Q_scope.

(** Unit roundoff, 2^-53. *)
Definition u : Q := Eval compute in 1 # (2 ^ 53).

(** The smallest normal number, 2^-1022, and half of the smallest number, 2^-1075. *)
Definition normal : Q := Eval compute in 1 # (2 ^ 1022).
Definition eta : Q := Eval compute in 1 # (2 ^ 1075).

(** Every finite f64 is a multiple of 2^-1074. *)
Definition is_float (x : Q) : Prop := exists k : Z, x == inject_Z k * (1 # (2 ^ 1074)).

(** What is known of a rounding function; [nearest] below is one. *)
Record rounds (fl : Q -> Q) : Prop := {
  fl_float : forall x, is_float (fl x);
  fl_sign : forall x, 0 <= x -> 0 <= fl x;
  fl_relative : forall x, normal <= x \/ x <= - normal \/ x == 0 -> Qabs (fl x - x) <= u * Qabs x;
  fl_absolute : forall x, Qabs (fl x - x) <= u * Qabs x + eta;
  (** Sums and differences of floats are exact below the normal numbers. *)
  fl_sum : forall x y, is_float x -> is_float y -> Qabs (fl (x + y) - (x + y)) <= u * Qabs (x + y);
  fl_difference : forall x y, is_float x -> is_float y -> Qabs (fl (x - y) - (x - y)) <= u * Qabs (x - y)
}.

(** ** Factors of several roundings *)

Fixpoint low (n : nat) : Q := match n with O => 1 | S m => (1 - u) * low m end.

Lemma low_bounds n : 0 < low n <= 1.
Proof. induction n; cbn [low]; [lra|]. unfold u in *. split; nra. Qed.

Lemma low_add n m : low (n + m) == low n * low m.
Proof. induction n; cbn [low Nat.add]; [ring|]. rewrite IHn. ring. Qed.

Lemma low_decreases n m : (n <= m)%nat -> low m <= low n.
Proof.
  intros. replace m with (n + (m - n))%nat by lia. rewrite low_add.
  pose proof (low_bounds n). pose proof (low_bounds (m - n)). nra.
Qed.

(** x' is x after at most n roundings: x times a factor in [(1 - u)^n, (1 - u)^-n]. *)
Definition approx (n : nat) (x x' : Q) : Prop := exists p, x' == x * p /\ low n <= p /\ p * low n <= 1.

Lemma approx_refl x : approx 0 x x.
Proof. exists 1. cbn. split; [ring | lra]. Qed.

Lemma approx_eq n x x' y y' : approx n x x' -> x == y -> x' == y' -> approx n y y'.
Proof. intros (p & E & H) Hx Hx'. exists p. rewrite <- Hx', <- Hx. auto. Qed.

Lemma approx_weaken n m x x' : (n <= m)%nat -> approx n x x' -> approx m x x'.
Proof.
  intros Hnm (p & E & L & H). pose proof (low_decreases n m Hnm). pose proof (low_bounds n).
  pose proof (low_bounds m). exists p. repeat split; [assumption | lra | nra].
Qed.

Theorem approx_mul n m x x' y y' : approx n x x' -> approx m y y' -> approx (n + m) (x * y) (x' * y').
Proof.
  intros (p & E & L & H) (q & F & K & G). pose proof (low_bounds n). pose proof (low_bounds m).
  exists (p * q). rewrite low_add. repeat split.
  - rewrite E, F. ring.
  - nra.
  - setoid_replace (p * q * (low n * low m)) with ((p * low n) * (q * low m)) by ring.
    assert (0 < p * low n) by nra. assert (0 < q * low m) by nra. nra.
Qed.

Lemma approx_inverse m y y' : ~ y == 0 -> approx m y y' -> ~ y' == 0 /\ approx m (/ y) (/ y').
Proof.
  intros Hy (q & F & K & G). pose proof (low_bounds m).
  assert (Hq : 0 < q) by lra. assert (Hqn : ~ q == 0) by lra.
  assert (Hi : 0 < / q) by (apply Qinv_lt_0_compat; assumption).
  assert (Hqi : q * / q == 1) by (apply Qmult_inv_r; assumption).
  split.
  - rewrite F. intro Z. apply Qmult_integral in Z. tauto.
  - exists (/ q). repeat split.
    + rewrite F, Qinv_mult_distr. reflexivity.
    + assert (q * low m * / q <= 1 * / q) by (apply Qmult_le_compat_r; lra).
      setoid_replace (q * low m * / q) with (low m * (q * / q)) in H0 by ring. rewrite Hqi in H0. lra.
    + assert (low m * / q <= q * / q) by (apply Qmult_le_compat_r; lra). lra.
Qed.

Lemma approx_div n m x x' y y' : ~ y == 0 -> approx n x x' -> approx m y y' -> approx (n + m) (x / y) (x' / y').
Proof. intros Hy Hx H. apply approx_mul; [assumption | apply approx_inverse; assumption]. Qed.

(** A sum of numbers that are not negative is off by no larger a factor than its parts. *)
Lemma approx_add n x x' y y' : 0 <= x -> 0 <= y -> approx n x x' -> approx n y y' -> approx n (x + y) (x' + y').
Proof.
  intros Hx Hy (p & E & L & H) (q & F & K & G). pose proof (low_bounds n).
  destruct (Qlt_le_dec 0 (x + y)) as [S | S].
  - exists ((x' + y') / (x + y)).
    assert (Hn : ~ x + y == 0) by lra.
    assert (M : x' + y' == (x + y) * ((x' + y') / (x + y))) by (field; assumption).
    repeat split; [assumption | |].
    + apply Qle_shift_div_l; [assumption|]. rewrite E, F. nra.
    + setoid_replace ((x' + y') / (x + y) * low n) with ((x' + y') * low n / (x + y)) by (field; assumption).
      apply Qle_shift_div_r; [assumption|]. rewrite E, F.
      setoid_replace ((x * p + y * q) * low n) with (x * (p * low n) + y * (q * low n)) by ring. nra.
  - assert (x == 0) by lra. assert (y == 0) by lra. exists p. repeat split; [| assumption | assumption].
    rewrite E, F. setoid_replace x with 0 by lra. setoid_replace y with 0 by lra. ring.
Qed.

(** A rounding as a factor. *)
Lemma rounding_factor x z : Qabs (z - x) <= u * Qabs x -> exists d, z == x * (1 + d) /\ - u <= d <= u.
Proof.
  intros R. destruct (Qeq_dec x 0) as [Z | Z].
  - exists 0. rewrite Z in R. change (Qabs 0) with 0 in R. rewrite Qmult_0_r in R.
    apply Qabs_Qle_condition in R. split; [lra | unfold u; lra].
  - exists (z / x - 1). split; [field; assumption|].
    assert (B : Qabs (z / x - 1) <= u).
    { setoid_replace (z / x - 1) with ((z - x) * / x) by (field; assumption).
      rewrite Qabs_Qmult, Qabs_Qinv.
      assert (0 < Qabs x).
      { destruct (Qlt_le_dec 0 (Qabs x)) as [|N]; [assumption|]. exfalso. apply Z.
        apply Qabs_Qle_condition in N. lra. }
      apply Qle_shift_div_r; assumption. }
    apply Qabs_Qle_condition in B. exact B.
Qed.

Lemma approx_factor n x x' d : - u <= d <= u -> approx n x x' -> approx (S n) x (x' * (1 + d)).
Proof.
  intros D (p & E & L & H). pose proof (low_bounds n).
  exists (p * (1 + d)). cbn [low]. repeat split.
  - rewrite E. ring.
  - unfold u in *. nra.
  - setoid_replace (p * (1 + d) * ((1 - u) * low n)) with ((p * low n) * ((1 + d) * (1 - u))) by ring.
    assert (0 < p * low n) by nra.
    assert (0 <= (1 + d) * (1 - u) <= 1) by (unfold u in *; split; nra). nra.
Qed.

(** One rounding more. *)
Lemma approx_round n x x' z : Qabs (z - x') <= u * Qabs x' -> approx n x x' -> approx (S n) x z.
Proof.
  intros R A. destruct (rounding_factor _ _ R) as (d & Z & D).
  apply (approx_eq (S n) x (x' * (1 + d))); [apply approx_factor; assumption | reflexivity | symmetry; exact Z].
Qed.

(** How far a factor is from 1: n u, but for products of errors, which are less than 2^-44 of it up to 20 roundings. *)
Definition rate : Q := Eval compute in u * (1 + (1 # (2 ^ 44))).
Definition drift (n : nat) : Q := inject_Z (Z.of_nat n) * rate.

Lemma low_drift n : (n <= 20)%nat -> 1 <= (1 + drift n) * low n /\ 1 - drift n <= low n.
Proof.
  intros. do 21 (destruct n as [|n]; [split; apply Qle_bool_iff; vm_compute; reflexivity|]). lia.
Qed.

Lemma factor_drift n p : (n <= 20)%nat -> low n <= p -> p * low n <= 1 -> - drift n <= p - 1 <= drift n.
Proof.
  intros Hn L H. destruct (low_drift n Hn). pose proof (low_bounds n). split; [lra|].
  destruct (Qlt_le_dec (1 + drift n) p) as [C|C]; [|lra]. exfalso.
  assert ((1 + drift n) * low n < p * low n) by nra. lra.
Qed.

Lemma approx_error n x x' : (n <= 20)%nat -> approx n x x' -> Qabs (x' - x) <= drift n * Qabs x.
Proof.
  intros Hn (p & E & L & H). pose proof (factor_drift n p Hn L H) as F.
  setoid_replace (x' - x) with ((p - 1) * x) by (rewrite E; ring).
  rewrite Qabs_Qmult. apply Qmult_le_compat_r; [apply Qabs_Qle_condition; exact F | apply Qabs_nonneg].
Qed.

Lemma approx_at n x x' : approx n x x' -> 0 <= x -> 0 <= x' /\ low n * x <= x' /\ x' * low n <= x.
Proof.
  intros (p & E & L & H) Hx. pose proof (low_bounds n). rewrite E. repeat split; [nra | nra |].
  setoid_replace (x * p * low n) with (x * (p * low n)) by ring. nra.
Qed.

(** A product that falls below the normal numbers: a relative error, and an absolute one. *)
Lemma split_error x z : Qabs (z - x) <= u * Qabs x + eta ->
  exists y e, z == y + e /\ Qabs (y - x) <= u * Qabs x /\ Qabs e <= eta.
Proof.
  intros H. apply Qabs_Qle_condition in H. pose proof (Qabs_nonneg x).
  assert (He : 0 <= eta) by (unfold eta; lra). assert (Hu : 0 <= u * Qabs x) by (unfold u; lra).
  destruct (Qlt_le_dec (u * Qabs x) (z - x)).
  - exists (x + u * Qabs x), (z - x - u * Qabs x).
    split; [ring|]. split; apply Qabs_Qle_condition; split; lra.
  - destruct (Qlt_le_dec (z - x) (- (u * Qabs x))).
    + exists (x - u * Qabs x), (z - x + u * Qabs x).
      split; [ring|]. split; apply Qabs_Qle_condition; split; lra.
    + exists z, 0. split; [ring|]. split; apply Qabs_Qle_condition; split; lra.
Qed.

(** ** Weights: numbers that are not negative and far from both ends of the range *)

Definition two (k : nat) : Q := inject_Z (2 ^ Z.of_nat k).

Lemma two_add j k : two (j + k) == two j * two k.
Proof. unfold two. rewrite Nat2Z.inj_add, Z.pow_add_r by lia. rewrite inject_Z_mult. reflexivity. Qed.

Lemma two_at_least_1 k : 1 <= two k.
Proof.
  unfold two. change 1 with (inject_Z 1). rewrite <- Zle_Qle.
  pose proof (Z.pow_pos_nonneg 2 (Z.of_nat k)). lia.
Qed.

Lemma two_increases j k : (j <= k)%nat -> two j <= two k.
Proof.
  intros. replace k with (j + (k - j))%nat by lia. rewrite two_add.
  pose proof (two_at_least_1 j). pose proof (two_at_least_1 (k - j)). nra.
Qed.

(** Between 2^-k and 2^k. *)
Definition sized (k : nat) (x : Q) : Prop := 1 <= x * two k /\ x <= two k.

Lemma sized_normal k x : (k <= 1022)%nat -> sized k x -> normal <= x.
Proof.
  intros Hk [L _]. pose proof (two_increases k 1022 Hk). pose proof (two_at_least_1 k).
  assert (E : normal * two 1022 == 1) by (apply Qeq_bool_iff; vm_compute; reflexivity).
  assert (0 < x) by nra. assert (1 <= x * two 1022) by nra.
  assert (0 < two 1022) by (pose proof (two_at_least_1 1022); lra).
  destruct (Qlt_le_dec x normal); [|assumption]. exfalso. nra.
Qed.

Record weight (n k : nat) (x x' : Q) : Prop := {
  w_exact : 0 <= x;
  w_approx : approx n x x';
  w_float : is_float x';
  w_sized : x' == 0 \/ sized k x'
}.

Lemma weight_weaken n k m j x x' : (n <= m)%nat -> (k <= j)%nat -> weight n k x x' -> weight m j x x'.
Proof.
  intros Hn Hk [E A F S]. split; [assumption | eapply approx_weaken; eassumption | assumption |].
  destruct S as [Z | [L U]]; [left; assumption | right].
  pose proof (two_increases k j Hk). pose proof (two_at_least_1 k).
  assert (0 < x') by nra. split; nra.
Qed.

Lemma approx_zero n x x' : approx n x x' -> x' == 0 -> x == 0.
Proof.
  intros (p & E & L & H) Z. pose proof (low_bounds n). rewrite E in Z.
  apply Qmult_integral in Z. destruct Z; [assumption | lra].
Qed.

Lemma weight_positive n k x x' : weight n k x x' -> 0 < x -> sized k x'.
Proof.
  intros [E A F [Z | S]] Hx; [|assumption]. exfalso. pose proof (approx_zero _ _ _ A Z). lra.
Qed.

Lemma integer_is_float z : is_float (inject_Z z).
Proof.
  exists (z * 2 ^ 1074)%Z. rewrite inject_Z_mult. rewrite <- Qmult_assoc.
  assert (E : inject_Z (2 ^ 1074) * (1 # 2 ^ 1074) == 1) by (apply Qeq_bool_iff; vm_compute; reflexivity).
  rewrite E. ring.
Qed.

Section Weights.
Variable fl : Q -> Q.
Hypothesis R : rounds fl.

(** A rounding changes the size by less than 2. *)
Lemma sized_round k x z : Qabs (z - x) <= u * Qabs x -> sized k x -> sized (k + 1) z.
Proof.
  intros H [L U]. pose proof (two_at_least_1 k).
  assert (0 < x) by nra. rewrite (Qabs_pos x) in H by lra. apply Qabs_Qle_condition in H.
  unfold sized. rewrite two_add. change (two 1) with 2. set (t := two k) in *. clearbody t. unfold u in *. split; nra.
Qed.

Lemma round_weight n k x x' : (k <= 1021)%nat -> 0 <= x -> approx n x x' -> x' == 0 \/ sized k x' ->
  weight (S n) (k + 1) x (fl x').
Proof.
  intros Hk Hx A Hs.
  assert (H : Qabs (fl x' - x') <= u * Qabs x').
  { apply (fl_relative _ R). destruct Hs as [Z | S]; [right; right; assumption | left].
    apply (sized_normal k); [lia | assumption]. }
  split; [assumption | eapply approx_round; eassumption | apply (fl_float _ R) |].
  destruct Hs as [Z | S].
  - left. rewrite Z in H at 2 3. change (Qabs 0) with 0 in H. rewrite Qmult_0_r in H.
    apply Qabs_Qle_condition in H. lra.
  - right. eapply sized_round; eassumption.
Qed.

Lemma weight_mul n k m j x x' y y' : (k + j <= 1021)%nat -> weight n k x x' -> weight m j y y' ->
  weight (n + m + 1) (k + j + 1) (x * y) (fl (x' * y')).
Proof.
  intros Hk [E A F S] [E2 A2 F2 S2]. replace (n + m + 1)%nat with (Datatypes.S (n + m)) by lia.
  apply round_weight; [assumption | nra | apply approx_mul; assumption |].
  destruct S as [Z | [L U]]; [left; rewrite Z; ring|].
  destruct S2 as [Z | [L2 U2]]; [left; rewrite Z; ring|]. right.
  pose proof (two_at_least_1 k). pose proof (two_at_least_1 j). unfold sized. rewrite two_add.
  set (t := two k) in *. set (w := two j) in *. clearbody t w.
  assert (0 < x') by nra. assert (0 < y') by nra. split; [|nra].
  setoid_replace (x' * y' * (t * w)) with ((x' * t) * (y' * w)) by ring. nra.
Qed.

Lemma weight_div n k m j x x' y y' : (k + j <= 1021)%nat -> 0 < y -> weight n k x x' -> weight m j y y' ->
  weight (n + m + 1) (k + j + 1) (x / y) (fl (x' / y')).
Proof.
  intros Hk Hy W W2. pose proof (weight_positive _ _ _ _ W2 Hy) as [L2 U2].
  destruct W as [E A F S]. destruct W2 as [E2 A2 F2 _].
  replace (n + m + 1)%nat with (Datatypes.S (n + m)) by lia.
  pose proof (two_at_least_1 k). pose proof (two_at_least_1 j).
  assert (Hy' : 0 < y') by nra.
  apply round_weight; [assumption | apply Qle_shift_div_l; lra | apply approx_div; [lra | assumption | assumption] |].
  destruct S as [Z | [L U]].
  - left. rewrite Z. field. lra.
  - right. unfold sized. rewrite two_add. set (t := two k) in *. set (w := two j) in *. clearbody t w.
    assert (0 < x') by nra. split.
    + setoid_replace (x' / y' * (t * w)) with (x' * t * w / y') by (field; lra).
      apply Qle_shift_div_l; [assumption|]. nra.
    + apply Qle_shift_div_r; [assumption|]. setoid_replace (t * w * y') with (t * (y' * w)) by ring. nra.
Qed.

Lemma weight_add n k x x' y y' : (k <= 1020)%nat -> weight n k x x' -> weight n k y y' ->
  weight (n + 1) (k + 2) (x + y) (fl (x' + y')).
Proof.
  intros Hk [E A F S] [E2 A2 F2 S2].
  assert (P : forall x', x' == 0 \/ sized k x' -> 0 <= x').
  { intros z [Z | [L _]]; [rewrite Z; lra | pose proof (two_at_least_1 k); nra]. }
  pose proof (P _ S) as P1. pose proof (P _ S2) as P2. clear P.
  replace (n + 1)%nat with (Datatypes.S n) by lia. replace (k + 2)%nat with (k + 1 + 1)%nat by lia.
  apply round_weight; [lia | lra | apply approx_add; assumption |].
  unfold sized in *. rewrite two_add. change (two 1) with 2.
  pose proof (two_at_least_1 k). set (t := two k) in *. clearbody t.
  destruct S as [Z | [L U]]; destruct S2 as [Z2 | [L2 U2]].
  - left. rewrite Z, Z2. ring.
  - right. rewrite Z. split; nra.
  - right. rewrite Z2. split; nra.
  - right. split; nra.
Qed.

Lemma weight_exact k z : (0 <= z < 2 ^ Z.of_nat k)%Z -> weight 0 k (inject_Z z) (inject_Z z).
Proof.
  intros H. split; [change 0 with (inject_Z 0); rewrite <- Zle_Qle; lia | apply approx_refl | apply integer_is_float |].
  destruct (Z.eq_dec z 0) as [-> | N]; [left; reflexivity | right].
  pose proof (two_at_least_1 k).
  assert (1 <= inject_Z z) by (change 1 with (inject_Z 1); rewrite <- Zle_Qle; lia).
  split; [nra|]. unfold two. rewrite <- Zle_Qle. lia.
Qed.

(** A whole number rounded to f64. *)
Lemma weight_integer k z : (k <= 1021)%nat -> (0 <= z < 2 ^ Z.of_nat k)%Z ->
  weight 1 (k + 1) (inject_Z z) (fl (inject_Z z)).
Proof.
  intros Hk H. destruct (weight_exact k z H) as [E A F S]. apply round_weight; assumption.
Qed.
End Weights.
