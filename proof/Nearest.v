(** Rounding to nearest, ties to even, with 53 bits and numbers from 2^-1074 on: what an operation on f64 returns
    while nothing overflows. It is a function that runs, and it rounds as [Rounding] says. *)
From Coq Require Import ZArith QArith Qabs Qpower Lia Lqa Bool.
From Rasterproof Require Import Rounding.
Open Scope Q_scope.

Definition pow2 (k : Z) : Q := 2 ^ k.

Lemma pow2_add j k : pow2 (j + k) == pow2 j * pow2 k.
Proof. apply Qpower_plus. lra. Qed.

Lemma pow2_positive k : 0 < pow2 k.
Proof. apply Qpower_0_lt. lra. Qed.

Lemma pow2_integer k : (0 <= k)%Z -> pow2 k == inject_Z (2 ^ k).
Proof. intros. symmetry. apply (Zpower_Qpower 2 k). assumption. Qed.

(** n / d to the nearest whole number, the even one of two. *)
Definition half_even (n d : Z) : Z :=
  let q := (n / d)%Z in let r := (n mod d)%Z in
  if (2 * r <? d)%Z then q else if (d <? 2 * r)%Z then (q + 1)%Z else if Z.even q then q else (q + 1)%Z.

Lemma half_even_near n d : (0 < d)%Z -> (- d <= 2 * (half_even n d * d - n) <= d)%Z.
Proof.
  intros Hd. unfold half_even. pose proof (Z.div_mod n d). pose proof (Z.mod_pos_bound n d Hd).
  destruct (Z.ltb_spec (2 * (n mod d)) d); [nia|].
  destruct (Z.ltb_spec d (2 * (n mod d))); [nia|]. destruct (Z.even (n / d)); nia.
Qed.

Lemma half_even_positive n d : (0 < d)%Z -> (0 <= n)%Z -> (0 <= half_even n d)%Z.
Proof.
  intros. pose proof (Z.div_pos n d). unfold half_even.
  destruct (_ <? _)%Z; [lia|]. destruct (_ <? _)%Z; [lia|]. destruct (Z.even _); lia.
Qed.

Lemma half_even_exact z d : (0 < d)%Z -> half_even (z * d) d = z.
Proof.
  intros. unfold half_even. rewrite Z.mod_mul, Z.div_mul by lia. destruct (Z.ltb_spec (2 * 0) d); [reflexivity | lia].
Qed.

Definition whole (y : Q) : Z := half_even (Qnum y) (QDen y).

Lemma whole_near y : Qabs (inject_Z (whole y) - y) <= 1 # 2.
Proof.
  pose proof (half_even_near (Qnum y) (QDen y) ltac:(lia)) as H. unfold whole.
  set (m := half_even _ _) in *. destruct y as [n d]. cbn [Qnum Qden] in *.
  apply Qabs_Qle_condition. unfold Qle, Qminus, Qplus, Qopp, inject_Z. cbn [Qnum Qden]. lia.
Qed.

Lemma whole_exact y z : y == inject_Z z -> whole y = z.
Proof.
  destruct y as [n d]. unfold Qeq, inject_Z, whole. cbn [Qnum Qden]. intros H.
  replace n with (z * Z.pos d)%Z by lia. apply half_even_exact. lia.
Qed.

(** The exponent of a positive number: 2^e <= x < 2^(e + 1). *)
Definition exponent (x : Q) : Z :=
  let e := (Z.log2 (Qnum x) - Z.log2 (QDen x))%Z in if Qle_bool (pow2 e) x then e else (e - 1)%Z.

Lemma exponent_spec x : 0 < x -> pow2 (exponent x) <= x < pow2 (exponent x + 1).
Proof.
  destruct x as [n d]. unfold exponent. cbn [Qnum Qden]. intros Hx.
  assert (Hn : (0 < n)%Z) by (unfold Qlt in Hx; cbn [Qnum Qden] in Hx; lia).
  pose proof (Z.log2_spec n Hn) as [Ln Un]. pose proof (Z.log2_spec (Z.pos d) ltac:(lia)) as [Ld Ud].
  pose proof (Z.log2_nonneg n) as Pn. pose proof (Z.log2_nonneg (Z.pos d)) as Pd.
  set (ln := Z.log2 n) in *. set (ld := Z.log2 (Z.pos d)) in *. clearbody ln ld.
  assert (Ex : (n # d) * inject_Z (Z.pos d) == inject_Z n) by (unfold Qeq, inject_Z, Qmult; cbn [Qnum Qden]; lia).
  assert (Dp : 0 < inject_Z (Z.pos d)) by (change 0 with (inject_Z 0); rewrite <- Zlt_Qlt; lia).
  rewrite Zle_Qle, <- pow2_integer in Ln by assumption. rewrite Zlt_Qlt, <- pow2_integer in Un by lia.
  rewrite Zle_Qle, <- pow2_integer in Ld by assumption. rewrite Zlt_Qlt, <- pow2_integer in Ud by lia.
  unfold Z.succ in *. rewrite pow2_add in Un, Ud. change (pow2 1) with 2 in *.
  pose proof (pow2_positive ln). pose proof (pow2_positive ld). pose proof (pow2_positive (ln - ld)).
  assert (Q : pow2 ln == pow2 (ln - ld) * pow2 ld) by (rewrite <- pow2_add; replace (ln - ld + ld)%Z with ln by lia; reflexivity).
  set (x := n # d) in *. set (dd := inject_Z (Z.pos d)) in *. set (nn := inject_Z n) in *. clearbody x dd nn.
  set (p := pow2 (ln - ld)) in *. set (q := pow2 ld) in *.
  destruct (Qle_bool p x) eqn:B.
  - apply Qle_bool_iff in B. rewrite pow2_add. fold p. change (pow2 1) with 2. split; [assumption|]. nra.
  - assert (C : x < p) by (destruct (Qlt_le_dec x p) as [|N]; [assumption | apply Qle_bool_iff in N; congruence]).
    replace (ln - ld - 1 + 1)%Z with (ln - ld)%Z by lia. fold p. split; [|assumption].
    assert (H2 : pow2 (ln - ld - 1) * 2 == p).
    { change 2 with (pow2 1). rewrite <- pow2_add. replace (ln - ld - 1 + 1)%Z with (ln - ld)%Z by lia. reflexivity. }
    set (h := pow2 (ln - ld - 1)) in *. clearbody h p q. nra.
Qed.

(** What the last bit of the result is worth: 2^this. *)
Definition last_bit (x : Q) : Z := Z.max (exponent x - 52) (-1074).

Definition nearest_positive (x : Q) : Q := inject_Z (whole (x * pow2 (- last_bit x))) * pow2 (last_bit x).

Definition nearest (x : Q) : Q :=
  if Qeq_bool x 0 then 0 else if Qle_bool 0 x then nearest_positive x else - nearest_positive (- x).

Lemma pow2_inverse k : pow2 (- k) * pow2 k == 1.
Proof. rewrite <- pow2_add. replace (- k + k)%Z with 0%Z by lia. reflexivity. Qed.

Lemma nearest_positive_near x : 0 < x -> Qabs (nearest_positive x - x) <= (1 # 2) * pow2 (last_bit x).
Proof.
  intros. unfold nearest_positive. set (k := last_bit x). pose proof (pow2_positive k).
  pose proof (whole_near (x * pow2 (- k))) as H1. set (m := inject_Z (whole (x * pow2 (- k)))) in *.
  assert (E : m * pow2 k - x == (m - x * pow2 (- k)) * pow2 k).
  { setoid_replace ((m - x * pow2 (- k)) * pow2 k) with (m * pow2 k - x * (pow2 (- k) * pow2 k)) by ring.
    rewrite pow2_inverse. ring. }
  rewrite E, Qabs_Qmult, (Qabs_pos (pow2 k)) by lra. apply Qmult_le_compat_r; lra.
Qed.

Lemma last_bit_relative x : 0 < x -> (-1074 <= exponent x - 52)%Z -> (1 # 2) * pow2 (last_bit x) <= u * x.
Proof.
  intros Hx He. unfold last_bit. rewrite Z.max_l by assumption. destruct (exponent_spec x Hx) as [L _].
  unfold Z.sub. rewrite pow2_add. assert (E : (1 # 2) * pow2 (- (52)) == u) by (apply Qeq_bool_iff; vm_compute; reflexivity).
  set (p := pow2 (exponent x)) in *. set (q := pow2 (- (52))) in *.
  setoid_replace ((1 # 2) * (p * q)) with (p * ((1 # 2) * q)) by ring. rewrite E. unfold u in *. lra.
Qed.

Lemma nearest_positive_absolute x : 0 < x -> Qabs (nearest_positive x - x) <= u * x + eta.
Proof.
  intros Hx. pose proof (nearest_positive_near x Hx) as N.
  destruct (Z_le_gt_dec (-1074) (exponent x - 52)) as [H | H].
  - pose proof (last_bit_relative x Hx H). assert (0 <= eta) by (apply Qle_bool_iff; vm_compute; reflexivity). lra.
  - unfold last_bit in N. rewrite Z.max_r in N by lia.
    assert (E : (1 # 2) * pow2 (-1074) == eta) by (apply Qeq_bool_iff; vm_compute; reflexivity).
    rewrite E in N. assert (0 <= u * x) by (unfold u; lra). lra.
Qed.

Lemma nearest_positive_relative x : normal <= x -> Qabs (nearest_positive x - x) <= u * x.
Proof.
  intros Hn. assert (Pn : 0 < normal) by reflexivity. assert (Hx : 0 < x) by lra.
  pose proof (nearest_positive_near x Hx) as N.
  destruct (Z_le_gt_dec (-1074) (exponent x - 52)) as [H | H].
  - pose proof (last_bit_relative x Hx H). lra.
  - exfalso. destruct (exponent_spec x Hx) as [_ U].
    assert (S : pow2 (exponent x + 1) <= pow2 (-1022)).
    { replace (-1022)%Z with (exponent x + 1 + (-1022 - (exponent x + 1)))%Z by lia.
      rewrite (pow2_add (exponent x + 1) (-1022 - (exponent x + 1))).
      pose proof (pow2_positive (exponent x + 1)).
      assert (1 <= pow2 (-1022 - (exponent x + 1))).
      { rewrite pow2_integer by lia. change 1 with (inject_Z 1). rewrite <- Zle_Qle.
        pose proof (Z.pow_pos_nonneg 2 (-1022 - (exponent x + 1))). lia. }
      set (p := pow2 (exponent x + 1)) in *. set (q := pow2 (-1022 - (exponent x + 1))) in *. clearbody p q. nra. }
    assert (E : pow2 (-1022) == normal) by (apply Qeq_bool_iff; vm_compute; reflexivity). rewrite E in S. lra.
Qed.

(** Below the normal numbers a sum of floats is a float. *)
Lemma nearest_positive_multiple x : 0 < x -> is_float x -> Qabs (nearest_positive x - x) <= u * x.
Proof.
  intros Hx [z Ez]. destruct (Z_le_gt_dec (-1074) (exponent x - 52)) as [H | H].
  - pose proof (nearest_positive_near x Hx). pose proof (last_bit_relative x Hx H). lra.
  - assert (E : nearest_positive x == x).
    { unfold nearest_positive, last_bit. rewrite Z.max_r by lia.
      assert (E1 : (1 # 2 ^ 1074) == pow2 (-1074)) by (apply Qeq_bool_iff; vm_compute; reflexivity).
      rewrite (whole_exact _ z).
      - rewrite Ez, E1. reflexivity.
      - rewrite Ez, E1. setoid_replace (inject_Z z * pow2 (-1074) * pow2 (- -1074)) with
          (inject_Z z * (pow2 (- -1074) * pow2 (-1074))) by ring. rewrite pow2_inverse. ring. }
    rewrite E. setoid_replace (x - x) with 0 by ring. change (Qabs 0) with 0. unfold u. lra.
Qed.

Lemma is_float_opp x : is_float x -> is_float (- x).
Proof. intros [k E]. exists (- k)%Z. rewrite E, inject_Z_opp. ring. Qed.

Lemma is_float_add x y : is_float x -> is_float y -> is_float (x + y).
Proof. intros [k E] [j F]. exists (k + j)%Z. rewrite E, F, inject_Z_plus. ring. Qed.

Lemma is_float_eq x y : x == y -> is_float x -> is_float y.
Proof. intros E [k F]. exists k. rewrite <- E. exact F. Qed.

Lemma nearest_positive_float x : is_float (nearest_positive x).
Proof.
  unfold nearest_positive. set (m := whole _). assert (H : (0 <= last_bit x + 1074)%Z) by (unfold last_bit; lia).
  exists (m * 2 ^ (last_bit x + 1074))%Z.
  rewrite inject_Z_mult, <- pow2_integer by assumption. rewrite pow2_add.
  assert (E1 : pow2 1074 * (1 # 2 ^ 1074) == 1) by (apply Qeq_bool_iff; vm_compute; reflexivity).
  setoid_replace (inject_Z m * (pow2 (last_bit x) * pow2 1074) * (1 # 2 ^ 1074)) with
    (inject_Z m * pow2 (last_bit x) * (pow2 1074 * (1 # 2 ^ 1074))) by ring. rewrite E1. ring.
Qed.

(** From positive numbers to all. *)
Lemma nearest_by_sign (P : Q -> Q -> Prop) x :
  (x == 0 -> P x 0) -> (0 < x -> P x (nearest_positive x)) -> (x < 0 -> P x (- nearest_positive (- x))) -> P x (nearest x).
Proof.
  intros Z Pos Neg. unfold nearest. destruct (Qeq_bool x 0) eqn:E.
  - apply Z, Qeq_bool_iff, E.
  - assert (N : ~ x == 0) by (intro H; apply Qeq_bool_iff in H; congruence).
    destruct (Qle_bool 0 x) eqn:S.
    + apply Qle_bool_iff in S. apply Pos. lra.
    + apply Neg. destruct (Qlt_le_dec x 0) as [|H]; [assumption | apply Qle_bool_iff in H; congruence].
Qed.

Lemma bound_by_sign x (b : Q -> Q) : (x == 0 -> 0 <= b x) ->
  (0 < x -> Qabs (nearest_positive x - x) <= b x) -> (x < 0 -> Qabs (nearest_positive (- x) - - x) <= b x) ->
  Qabs (nearest x - x) <= b x.
Proof.
  intros Z Pos Neg. apply (nearest_by_sign (fun x y => Qabs (y - x) <= b x)).
  - intros H. setoid_replace (0 - x) with 0 by (rewrite H; ring). change (Qabs 0) with 0. apply Z, H.
  - exact Pos.
  - intros H. rewrite <- Qabs_opp. setoid_replace (- (- nearest_positive (- x) - x)) with (nearest_positive (- x) - - x) by ring.
    apply Neg, H.
Qed.

Lemma abs_of_negative x : x < 0 -> Qabs x == - x.
Proof. intros. apply Qabs_neg. lra. Qed.

Theorem nearest_rounds : rounds nearest.
Proof.
  assert (He : 0 <= eta) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Hn : 0 < normal) by reflexivity.
  assert (multiple : forall x, is_float x -> Qabs (nearest x - x) <= u * Qabs x).
  { intros x F. apply (bound_by_sign x (fun x => u * Qabs x)).
    - intros E. rewrite E. apply Qle_bool_iff. vm_compute. reflexivity.
    - intros H. rewrite (Qabs_pos x) by lra. apply nearest_positive_multiple; assumption.
    - intros H. rewrite (abs_of_negative x H). apply nearest_positive_multiple; [lra | apply is_float_opp, F]. }
  split.
  - intros x. apply (nearest_by_sign (fun _ y => is_float y)); intros.
    + exists 0%Z. reflexivity.
    + apply nearest_positive_float.
    + apply is_float_opp, nearest_positive_float.
  - intros x. apply (nearest_by_sign (fun x y => 0 <= x -> 0 <= y)); intros; [lra | | lra].
    unfold nearest_positive. apply Qmult_le_0_compat; [| pose proof (pow2_positive (last_bit x)); lra].
    change 0 with (inject_Z 0). rewrite <- Zle_Qle. apply half_even_positive; [lia|].
    assert (0 <= x * pow2 (- last_bit x)).
    { apply Qmult_le_0_compat; [assumption | pose proof (pow2_positive (- last_bit x)); lra]. }
    unfold Qle in H1. cbn [Qnum Qden] in H1. lia.
  - intros x H. apply (bound_by_sign x (fun x => u * Qabs x)).
    + intros E. rewrite E. apply Qle_bool_iff. vm_compute. reflexivity.
    + intros P. rewrite (Qabs_pos x) by lra. apply nearest_positive_relative. lra.
    + intros P. rewrite (abs_of_negative x P). apply nearest_positive_relative. lra.
  - intros x. apply (bound_by_sign x (fun x => u * Qabs x + eta)).
    + intros E. rewrite E. change (Qabs 0) with 0. lra.
    + intros P. rewrite (Qabs_pos x) by lra. apply nearest_positive_absolute. assumption.
    + intros P. rewrite (abs_of_negative x P). apply nearest_positive_absolute. lra.
  - intros x y Fx Fy. apply multiple, is_float_add; assumption.
  - intros x y Fx Fy. apply multiple. apply (is_float_eq (x + - y)); [ring|]. apply is_float_add; [|apply is_float_opp]; assumption.
Qed.
