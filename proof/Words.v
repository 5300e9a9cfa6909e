(** Machine integers. A model in checked words asks after every operation and cast whether the type
    of the Rust line holds the result: [Some] where it does, [None] where Rust would panic in a debug
    build and silently change the number in a release build. *)
From Coq Require Import ZArith Lia Bool.
Open Scope Z_scope.

Record word := Word { low : Z; high : Z }.

Definition i32 := Word (-2147483648) 2147483647.
Definition i64 := Word (-9223372036854775808) 9223372036854775807.
Definition i128 := Word (-170141183460469231731687303715884105728) 170141183460469231731687303715884105727.
Definition u32 := Word 0 4294967295.
Definition u64 := Word 0 18446744073709551615.
Definition u128 := Word 0 340282366920938463463374607431768211455.

Definition is_in (w : word) (z : Z) : bool := (low w <=? z) && (z <=? high w).

(** The result of an operation, or of a cast, if the word holds it. *)
Definition fit (w : word) (z : Z) : option Z := if is_in w z then Some z else None.

Notation "'let*' x := e 'in' k" := (match e with Some x => k | None => None end)
  (at level 200, x pattern, e at level 200, k at level 200, right associativity).

Lemma fit_ok w z : low w <= z <= high w -> fit w z = Some z.
Proof.
  intros H. unfold fit, is_in.
  destruct (Z.leb_spec (low w) z), (Z.leb_spec z (high w)); try reflexivity; lia.
Qed.

(** The sign of a word, spread over all its bits, and a mask made of it. *)
Lemma sign_mask w z : low i64 <= w <= high i64 ->
  Z.land z (Z.shiftr w 63) = if w <? 0 then z else 0.
Proof.
  cbn [low high i64]. intros H. rewrite Z.shiftr_div_pow2 by lia.
  destruct (Z.ltb_spec w 0).
  - replace (w / 2 ^ 63) with (-1); [apply Z.land_m1_r |].
    apply Z.div_unique with (r := w + 2 ^ 63); lia.
  - rewrite Z.div_small by lia. apply Z.land_0_r.
Qed.

Lemma sign_bit w : low i64 <= w <= high i64 -> Z.shiftr w 63 = if w <? 0 then -1 else 0.
Proof. intros H. rewrite <- (sign_mask w (-1) H). symmetry. apply Z.land_m1_l. Qed.

Lemma shift_8 z : Z.shiftr z 8 = z / 256.
Proof. rewrite Z.shiftr_div_pow2 by lia. reflexivity. Qed.

Lemma mask_8 z : Z.land z 255 = z mod 256.
Proof. exact (Z.land_ones z 8 ltac:(lia)). Qed.

(** Two numbers side by side in one word. *)
Lemma pack_32 y x : 0 <= x < 2 ^ 32 -> Z.lor (Z.shiftl y 32) x = y * 2 ^ 32 + x.
Proof.
  intros Hx. rewrite Z.shiftl_mul_pow2 by lia.
  rewrite <- Z.lxor_lor, <- Z.add_nocarry_lxor; try reflexivity.
  all: apply Z.bits_inj'; intros n Hn; rewrite Z.land_spec, Z.bits_0;
    rewrite <- (Z.shiftl_mul_pow2 y 32), Z.shiftl_spec by lia;
    (destruct (Z.lt_ge_cases n 32);
      [rewrite (Z.testbit_neg_r y) by lia; reflexivity |]);
    replace (Z.testbit x n) with false; [apply andb_false_r |];
    symmetry; destruct (Z.eq_dec x 0) as [-> |]; [apply Z.bits_0 |];
    apply Z.bits_above_log2; try lia; apply Z.log2_lt_pow2; try lia;
    apply Z.lt_le_trans with (2 ^ 32); try lia; apply Z.pow_le_mono_r; lia.
Qed.

Ltac fits_word := cbn [low high i32 i64 i128 u32 u64 u128]; lia.
Ltac step_word := match goal with |- context [fit ?w ?z] => rewrite (fit_ok w z) by fits_word end.
