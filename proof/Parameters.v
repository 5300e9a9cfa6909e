(** The parameters of interpolation, with the rounding of f64: crates/core/src/raster/scanline/values.rs,
    crates/core/src/line/dda.rs and crates/core/src/line/bresenham.rs. Those of attributes and lines never leave [0, 1],
    and no operation is a clamp. That of a row's depth may, by less than 8 units roundoff. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa Bool.
From Rasterproof Require Import Rounding RoundedModel RoundedValues Nearest.
Open Scope Q_scope.

(** ** Rounding keeps the order *)

Lemma half_even_tie n d : (0 < d)%Z -> (2 * (n mod d) = d)%Z -> Z.even (half_even n d) = true.
Proof.
  intros Hd H. unfold half_even. destruct (Z.ltb_spec (2 * (n mod d)) d); [lia|].
  destruct (Z.ltb_spec d (2 * (n mod d))); [lia|]. destruct (Z.even (n / d)) eqn:E; [assumption|].
  rewrite Z.add_1_r, Z.even_succ, <- Z.negb_even, E. reflexivity.
Qed.

Lemma whole_tie x z : x == inject_Z z + (1 # 2) -> Z.even (whole x) = true.
Proof.
  destruct x as [n d]. unfold whole, Qeq, Qplus, inject_Z. cbn [Qnum Qden]. intros H.
  apply half_even_tie; [lia|]. symmetry in H.
  pose proof (Z.mod_unique n (Z.pos d) z (n - z * Z.pos d) ltac:(lia) ltac:(lia)). lia.
Qed.

Lemma whole_monotone x y : x <= y -> (whole x <= whole y)%Z.
Proof.
  intros H. destruct (Z_le_gt_dec (whole x) (whole y)) as [|G]; [assumption | exfalso].
  pose proof (whole_near x) as Nx. pose proof (whole_near y) as Ny.
  apply Qabs_Qle_condition in Nx, Ny.
  assert (G1 : inject_Z (whole y) + 1 <= inject_Z (whole x)).
  { change 1 with (inject_Z 1). rewrite <- inject_Z_plus, <- Zle_Qle. lia. }
  assert (Ex : x == inject_Z (whole y) + (1 # 2)) by lra. assert (Ey : y == inject_Z (whole y) + (1 # 2)) by lra.
  assert (W : inject_Z (whole x) == inject_Z (whole y + 1)) by (rewrite inject_Z_plus; change (inject_Z 1) with 1; lra).
  assert (W1 : whole x = (whole y + 1)%Z) by (unfold Qeq, inject_Z in W; cbn [Qnum Qden] in W; lia).
  pose proof (whole_tie x _ Ex) as A. pose proof (whole_tie y _ Ey) as B.
  rewrite W1, Z.add_1_r, Z.even_succ, <- Z.negb_even, B in A. discriminate.
Qed.

Lemma pow2_le j k : (j <= k)%Z -> pow2 j <= pow2 k.
Proof.
  intros. replace k with (j + (k - j))%Z by lia. rewrite pow2_add, (pow2_integer (k - j)) by lia.
  pose proof (pow2_positive j). assert (1 <= inject_Z (2 ^ (k - j))).
  { change 1 with (inject_Z 1). rewrite <- Zle_Qle. pose proof (Z.pow_pos_nonneg 2 (k - j)). lia. }
  set (p := pow2 j) in *. set (q := inject_Z _) in *. clearbody p q. nra.
Qed.

Lemma scaled_whole x k : x * pow2 (- k) * pow2 k == x.
Proof. rewrite <- Qmult_assoc, pow2_inverse. ring. Qed.

Lemma scaled_le x y k : x <= y -> x * pow2 (- k) <= y * pow2 (- k).
Proof. intros. apply Qmult_le_compat_r; [assumption | pose proof (pow2_positive (- k)); lra]. Qed.

(** A power of two below or above a number stays there when the number is rounded. *)
Lemma whole_power e k : (k <= e)%Z -> whole (pow2 e * pow2 (- k)) = (2 ^ (e - k))%Z.
Proof.
  intro H. apply whole_exact. rewrite <- pow2_add, <- pow2_integer by lia.
  replace (e + - k)%Z with (e - k)%Z by lia. reflexivity.
Qed.

Lemma power_apart e k : pow2 e == pow2 (e - k) * pow2 k.
Proof. rewrite <- pow2_add. replace (e - k + k)%Z with e by lia. reflexivity. Qed.

Lemma rounded_below x e : (last_bit x <= e)%Z -> x <= pow2 e -> nearest_positive x <= pow2 e.
Proof.
  intros He H. unfold nearest_positive. set (k := last_bit x) in *.
  assert (W : (whole (x * pow2 (- k)) <= 2 ^ (e - k))%Z).
  { rewrite <- (whole_power e k) by assumption. apply whole_monotone, scaled_le, H. }
  rewrite Zle_Qle, <- pow2_integer in W by lia. pose proof (pow2_positive k).
  rewrite (power_apart e k). apply Qmult_le_compat_r; lra.
Qed.

Lemma rounded_above x e : (last_bit x <= e)%Z -> pow2 e <= x -> pow2 e <= nearest_positive x.
Proof.
  intros He H. unfold nearest_positive. set (k := last_bit x) in *.
  assert (W : (2 ^ (e - k) <= whole (x * pow2 (- k)))%Z).
  { rewrite <- (whole_power e k) by assumption. apply whole_monotone, scaled_le, H. }
  rewrite Zle_Qle, <- pow2_integer in W by lia. pose proof (pow2_positive k).
  rewrite (power_apart e k). apply Qmult_le_compat_r; lra.
Qed.

Lemma exponent_monotone x y : 0 < x -> x <= y -> (exponent x <= exponent y)%Z.
Proof.
  intros Hx H. destruct (exponent_spec x Hx) as [L _]. destruct (exponent_spec y ltac:(lra)) as [_ U].
  destruct (Z_le_gt_dec (exponent x) (exponent y)) as [|G]; [assumption | exfalso].
  pose proof (pow2_le (exponent y + 1) (exponent x) ltac:(lia)). lra.
Qed.

Lemma positive_monotone x y : 0 < x -> x <= y -> nearest_positive x <= nearest_positive y.
Proof.
  intros Hx H. pose proof (exponent_monotone x y Hx H) as E.
  destruct (Z.eq_dec (last_bit x) (last_bit y)) as [K | K].
  - unfold nearest_positive. rewrite K. apply Qmult_le_compat_r; [|pose proof (pow2_positive (last_bit y)); lra].
    rewrite <- Zle_Qle. apply whole_monotone, scaled_le, H.
  - destruct (exponent_spec x Hx) as [_ U]. destruct (exponent_spec y ltac:(lra)) as [L _].
    assert (S : (exponent x + 1 <= exponent y)%Z /\ (last_bit x <= exponent y)%Z /\ (last_bit y <= exponent y)%Z)
      by (unfold last_bit in *; lia).
    destruct S as (S1 & S2 & S3). pose proof (pow2_le _ _ S1).
    apply Qle_trans with (pow2 (exponent y)); [apply rounded_below | apply rounded_above]; lra || assumption.
Qed.

Lemma nearest_of_positive x : 0 < x -> nearest x = nearest_positive x.
Proof.
  intros H. unfold nearest. destruct (Qeq_bool x 0) eqn:E; [apply Qeq_bool_iff in E; lra|].
  destruct (Qle_bool 0 x) eqn:L; [reflexivity|]. exfalso. assert (T : Qle_bool 0 x = true) by (apply Qle_bool_iff; lra). congruence.
Qed.

Lemma nearest_of_zero x : x == 0 -> nearest x = 0.
Proof. intros H. unfold nearest. apply Qeq_bool_iff in H. rewrite H. reflexivity. Qed.

Lemma nearest_not_negative x : 0 <= x -> 0 <= nearest x.
Proof. apply (fl_sign nearest nearest_rounds). Qed.

Theorem nearest_monotone x y : 0 <= x -> x <= y -> nearest x <= nearest y.
Proof.
  intros Hx H. destruct (Qeq_dec x 0) as [E | E].
  - rewrite (nearest_of_zero x E). apply nearest_not_negative. lra.
  - rewrite (nearest_of_positive x), (nearest_of_positive y) by lra. apply positive_monotone; lra.
Qed.

(** ** What was rounded is not changed by rounding it again *)

Definition double (v : Q) : Prop := exists m k, v == inject_Z m * pow2 k /\ (0 <= m <= 2 ^ 53)%Z /\ (-1074 <= k)%Z.

Lemma nearest_is_double x : 0 <= x -> double (nearest x).
Proof.
  intros Hx. destruct (Qeq_dec x 0) as [E | E].
  - rewrite (nearest_of_zero x E). exists 0%Z, 0%Z. split; [reflexivity | lia].
  - assert (P : 0 < x) by lra. rewrite (nearest_of_positive x P). unfold nearest_positive. set (k := last_bit x).
    exists (whole (x * pow2 (- k))), k. split; [reflexivity|]. destruct (exponent_spec x P) as [_ U].
    assert (K : (exponent x + 1 <= k + 53)%Z) by (unfold k, last_bit; lia). pose proof (pow2_le _ _ K).
    split; [|unfold k, last_bit; lia]. split.
    + rewrite <- (whole_exact 0 0) by reflexivity. apply whole_monotone.
      pose proof (pow2_positive (- k)). apply Qmult_le_0_compat; lra.
    + rewrite <- (whole_exact (pow2 (k + 53) * pow2 (- k)) (2 ^ 53)).
      * apply whole_monotone, scaled_le. lra.
      * rewrite <- pow2_add, <- pow2_integer by lia. replace (k + 53 + - k)%Z with 53%Z by lia. reflexivity.
Qed.

Lemma nearest_whole_multiple v k : 0 < v -> (exists m, v == inject_Z m * pow2 k) -> (last_bit v <= k)%Z -> nearest v == v.
Proof.
  intros P (m & E) K. rewrite (nearest_of_positive v P). unfold nearest_positive. set (j := last_bit v) in *.
  assert (S : v * pow2 (- j) == inject_Z (m * 2 ^ (k - j))).
  { rewrite E, inject_Z_mult, <- pow2_integer by lia. rewrite <- Qmult_assoc, <- pow2_add.
    replace (k + - j)%Z with (k - j)%Z by lia. reflexivity. }
  rewrite (whole_exact _ _ S), <- S. apply scaled_whole.
Qed.

Lemma nearest_of_double v : double v -> nearest v == v.
Proof.
  intros (m & k & E & M & K). destruct (Z.eq_dec m 0) as [Z | Z].
  { subst m. assert (V : v == 0) by (rewrite E; change (inject_Z 0) with 0; ring). rewrite (nearest_of_zero v V), V. reflexivity. }
  pose proof (pow2_positive k).
  assert (M1 : 1 <= inject_Z m) by (change 1 with (inject_Z 1); rewrite <- Zle_Qle; lia).
  assert (P : 0 < v) by (rewrite E; nra). destruct (exponent_spec v P) as [L _].
  destruct (Z.eq_dec m (2 ^ 53)) as [T | T].
  - apply (nearest_whole_multiple v (k + 1) P).
    + exists (2 ^ 52)%Z. rewrite E, T, pow2_add. change (pow2 1) with 2.
      setoid_replace (inject_Z (2 ^ 53)) with (inject_Z (2 ^ 52) * 2) by reflexivity. ring.
    + assert (V : v == pow2 (53 + k)) by (rewrite E, T, pow2_add, (pow2_integer 53) by lia; reflexivity).
      destruct (Z_le_gt_dec (exponent v) (k + 53)) as [|G]; [unfold last_bit; lia | exfalso].
      pose proof (pow2_le (k + 54) (exponent v) ltac:(lia)) as S.
      assert (L2 : pow2 (exponent v) <= pow2 (53 + k)) by lra.
      replace (k + 54)%Z with (53 + k + 1)%Z in S by lia. rewrite pow2_add in S. change (pow2 1) with 2 in S.
      pose proof (pow2_positive (53 + k)). lra.
  - apply (nearest_whole_multiple v k P); [exists m; assumption|].
    assert (V : v < pow2 (k + 53)).
    { rewrite E, pow2_add, (pow2_integer 53) by lia. rewrite Qmult_comm. apply Qmult_lt_l; [assumption|]. rewrite <- Zlt_Qlt. lia. }
    destruct (Z_le_gt_dec (exponent v) (k + 52)) as [|G]; [unfold last_bit; lia | exfalso].
    pose proof (pow2_le (k + 53) (exponent v) ltac:(lia)). lra.
Qed.

(** A sum is not below a part of it, rounded or not. *)
Theorem sum_above_part a b : 0 <= a -> double b -> b <= nearest (a + b).
Proof.
  intros Ha B. rewrite <- (nearest_of_double b B) at 1. apply nearest_monotone; [|lra].
  destruct B as (m & k & E & M & _). rewrite E. pose proof (pow2_positive k). apply Qmult_le_0_compat; [|lra].
  change 0 with (inject_Z 0). rewrite <- Zle_Qle. lia.
Qed.

Lemma nearest_one : nearest 1 == 1.
Proof. apply Qeq_bool_iff. vm_compute. reflexivity. Qed.

(** Half way from 1 to the next double, the even one of the two is 1. *)
Lemma nearest_one_and_half_a_step : nearest (1 + u) == 1.
Proof. apply Qeq_bool_iff. vm_compute. reflexivity. Qed.

Definition in_unit (t : Q) : Prop := 0 <= t <= 1.

Theorem quotient_in_unit b s : 0 <= b -> b <= s -> in_unit (nearest (b / s)).
Proof.
  intros Hb H. destruct (Qeq_dec s 0) as [Z | Z].
  - rewrite (nearest_of_zero (b / s)); [unfold in_unit; lra|].
    assert (B : b == 0) by lra. unfold Qdiv. rewrite B. ring.
  - assert (D : b / s <= 1) by (apply Qle_shift_div_r; lra).
    assert (P : 0 <= b / s) by (apply Qle_shift_div_l; lra).
    split; [apply nearest_not_negative, P|]. rewrite <- nearest_one. apply nearest_monotone; assumption.
Qed.

(** ** The parameters of the engines *)

(** Of a depth down an edge, and along a line. *)
Theorem whole_parameter_in_unit (i n : Z) : (0 <= i <= n)%Z -> in_unit (nearest (inject_Z i / inject_Z n)).
Proof. intros. apply quotient_in_unit; [change 0 with (inject_Z 0)|]; rewrite <- Zle_Qle; lia. Qed.

(** Of an attribute down an edge: [row_value]. *)
Theorem edge_parameter_in_unit below above qa qb : (0 <= below)%Z -> (0 <= above)%Z -> 0 <= qa -> 0 <= qb ->
  in_unit (nearest (nearest (inject_Z below * qb) / row_sum nearest below above qa qb)).
Proof.
  intros Hb Ha Qa Qb. rewrite Zle_Qle in Hb, Ha. change (inject_Z 0) with 0 in Hb, Ha.
  assert (B : 0 <= inject_Z below * qb) by nra. assert (A : 0 <= inject_Z above * qa) by nra.
  apply quotient_in_unit; [apply nearest_not_negative, B|]. unfold row_sum. apply sum_above_part.
  - apply nearest_not_negative, A.
  - apply nearest_is_double, B.
Qed.

Lemma rounded_reciprocal s : 0 < s -> s <= inject_Z (2 ^ 1022) -> nearest (1 / s) <= 1 / s * (1 + u).
Proof.
  intros P S. assert (I : normal <= 1 / s).
  { apply Qle_shift_div_l; [assumption|]. unfold normal.
    assert (E : (1 # 2 ^ 1022) * inject_Z (2 ^ 1022) == 1) by (apply Qeq_bool_iff; vm_compute; reflexivity).
    apply Qle_trans with ((1 # 2 ^ 1022) * inject_Z (2 ^ 1022)); [|lra].
    rewrite !(Qmult_comm (1 # 2 ^ 1022)). apply Qmult_le_compat_r; [assumption | discriminate]. }
  assert (N : 0 < normal) by reflexivity.
  pose proof (fl_relative nearest nearest_rounds (1 / s) (or_introl I)) as R.
  rewrite (Qabs_pos (1 / s)) in R by lra. apply Qabs_Qle_condition in R. lra.
Qed.

(** Of an attribute along a row: [row_place]. It multiplies by a rounded reciprocal, so that the exact product may be
    above 1, by half a step. *)
Theorem row_parameter_in_unit l r ql qr : (0 <= l)%Z -> (0 <= r)%Z -> 0 <= ql -> 0 <= qr ->
  nearest (nearest (nearest (inject_Z r) * ql) + nearest (nearest (inject_Z l) * qr)) <= inject_Z (2 ^ 1022) ->
  in_unit (row_place nearest l r ql qr).
Proof.
  intros Hl Hr Ql Qr S. rewrite Zle_Qle in Hl, Hr. change (inject_Z 0) with 0 in Hl, Hr. unfold row_place. cbv zeta.
  pose proof (nearest_not_negative _ Hl) as L. pose proof (nearest_not_negative _ Hr) as R.
  set (x := nearest (nearest (inject_Z l) * qr)) in *. set (y := nearest (nearest (inject_Z r) * ql)) in *.
  assert (X : 0 <= nearest (inject_Z l) * qr) by (apply Qmult_le_0_compat; assumption).
  assert (Y : 0 <= nearest (inject_Z r) * ql) by (apply Qmult_le_0_compat; assumption).
  pose proof (nearest_not_negative _ X) as X0. pose proof (nearest_not_negative _ Y) as Y0.
  pose proof (sum_above_part y x Y0 (nearest_is_double _ X)) as A. fold x in X0. fold y in Y0.
  set (s := nearest (y + x)) in *. destruct (Qeq_dec s 0) as [Z | Z].
  - assert (E : x * nearest (1 / s) == 0) by (assert (B : x == 0) by lra; rewrite B; ring).
    rewrite (nearest_of_zero _ E). unfold in_unit. lra.
  - assert (P : 0 < s) by lra. pose proof (rounded_reciprocal s P S) as I.
    assert (J : 0 <= nearest (1 / s)) by (apply nearest_not_negative, Qle_shift_div_l; lra).
    assert (B : x * nearest (1 / s) <= 1 + u).
    { apply Qle_trans with (s * nearest (1 / s)); [apply Qmult_le_compat_r; assumption|].
      apply Qle_trans with (s * (1 / s * (1 + u))).
      - rewrite !(Qmult_comm s). apply Qmult_le_compat_r; lra.
      - setoid_replace (s * (1 / s * (1 + u))) with (1 + u) by (field; assumption). lra. }
    split; [apply nearest_not_negative, Qmult_le_0_compat; assumption|].
    apply Qle_trans with (nearest (1 + u)); [|rewrite nearest_one_and_half_a_step; lra].
    apply nearest_monotone; [apply Qmult_le_0_compat; assumption | assumption].
Qed.

(** The sum is that small wherever the engine computes it: distances are below 2^68, and a 1/w over the largest of the
    three is at most 1, times a height below 2^33. *)
Corollary row_parameter_of_the_domain l r ql qr : (0 <= l < 2 ^ 68)%Z -> (0 <= r < 2 ^ 68)%Z ->
  0 <= ql <= inject_Z (2 ^ 40) -> 0 <= qr <= inject_Z (2 ^ 40) -> in_unit (row_place nearest l r ql qr).
Proof.
  intros Hl Hr Ql Qr. apply row_parameter_in_unit; try lia; try lra.
  assert (part : forall z q, (0 <= z < 2 ^ 68)%Z -> 0 <= q <= inject_Z (2 ^ 40) ->
    0 <= nearest (nearest (inject_Z z) * q) <= inject_Z (2 ^ 108)).
  { intros z q [Z0 Z1] Q. assert (P : 0 <= inject_Z z) by (change 0 with (inject_Z 0); rewrite <- Zle_Qle; assumption).
    assert (B : nearest (inject_Z z) <= inject_Z (2 ^ 68)).
    { apply Qle_trans with (nearest (inject_Z (2 ^ 68))); [apply nearest_monotone; [assumption | rewrite <- Zle_Qle; lia]|].
      apply Qle_bool_iff. vm_compute. reflexivity. }
    pose proof (nearest_not_negative _ P) as N. assert (M : 0 <= nearest (inject_Z z) * q) by (apply Qmult_le_0_compat; lra).
    split; [apply nearest_not_negative, M|].
    apply Qle_trans with (nearest (inject_Z (2 ^ 108))); [apply nearest_monotone; [assumption|] | apply Qle_bool_iff; vm_compute; reflexivity].
    setoid_replace (inject_Z (2 ^ 108)) with (inject_Z (2 ^ 68) * inject_Z (2 ^ 40)) by reflexivity.
    apply Qle_trans with (inject_Z (2 ^ 68) * q); [apply Qmult_le_compat_r; lra|].
    rewrite !(Qmult_comm (inject_Z (2 ^ 68))). apply Qmult_le_compat_r; [lra | discriminate]. }
  pose proof (part r ql Hr Ql). pose proof (part l qr Hl Qr).
  apply Qle_trans with (nearest (inject_Z (2 ^ 108) + inject_Z (2 ^ 108))); [apply nearest_monotone; lra|].
  apply Qle_bool_iff. vm_compute. reflexivity.
Qed.

(** Of a depth along a row: [depth_place]. Two products follow the reciprocal, so that it may come out above 1: by less
    than 8 units roundoff, which the bound of the depth contains. *)
Theorem depth_parameter_near_unit l r l0 r0 hl hr : (0 <= l < 2 ^ 68)%Z -> (0 < r < 2 ^ 68)%Z ->
  (0 <= l0 < 2 ^ 68)%Z -> (0 < r0 < 2 ^ 68)%Z -> (0 < hl < 2 ^ 33)%Z -> (0 < hr < 2 ^ 33)%Z ->
  (l0 * hr + r0 * hl = l * hr + r * hl)%Z -> 0 <= depth_place nearest l l0 r0 hl hr <= 1 + 8 * u.
Proof.
  intros Hl Hr Hl0 Hr0 Hhl Hhr Hw.
  destruct (depth_place_error nearest nearest_rounds l r Hl Hr l0 r0 hl hr Hl0 Hr0 Hhl Hhr Hw) as (E & P & _ & T).
  split; [exact P|]. apply Qabs_Qle_condition in E.
  assert (drift 7 <= 8 * u) by (apply Qle_bool_iff; vm_compute; reflexivity). lra.
Qed.

Theorem depth_parameter_leaves_unit : exists l r hl hr, (0 < r)%Z /\ 1 < depth_place nearest l l r hl hr.
Proof.
  exists 32530608651%Z, 1%Z, 26%Z, 14998088%Z. split; [reflexivity|].
  assert (B : Qle_bool (depth_place nearest 32530608651 32530608651 1 26 14998088) 1 = false) by (vm_compute; reflexivity).
  apply Qnot_le_lt. intros H. apply Qle_bool_iff in H. congruence.
Qed.
