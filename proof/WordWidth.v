(** The word that the edge-function engine picks, [WordWidth::of] in crates/core/src/raster/edge_function.rs, is
    wide enough for S = 256 and corners in i32. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid EdgeFunction.
Open Scope Z_scope.

Definition word_width (a b c : point) : Z :=
  let padded p q r := max3 p q r - min3 p q r + 256 in
  let bound := padded (X a) (X b) (X c) * padded (Y a) (Y b) (Y c) in
  if bound / 256 <? 2 ^ 31 then 32 else if bound <? 2 ^ 63 then 64 else 128.

Definition in_i32 (p : point) : Prop := - 2 ^ 31 <= X p < 2 ^ 31 /\ - 2 ^ 31 <= Y p < 2 ^ 31.

Theorem word_width_is_enough a b c : in_i32 a -> in_i32 b -> in_i32 c ->
  word_is_wide_enough 128 (word_width a b c) a b c.
Proof.
  unfold in_i32. intros Ha Hb Hc. unfold word_is_wide_enough, word_width.
  change (2 * 128) with 256.
  set (u := max3 (X a) (X b) (X c) - min3 (X a) (X b) (X c) + 256).
  set (v := max3 (Y a) (Y b) (Y c) - min3 (Y a) (Y b) (Y c) + 256).
  assert (0 <= u <= 2 ^ 32 + 256) by (unfold u, max3, min3; lia).
  assert (0 <= v <= 2 ^ 32 + 256) by (unfold v, max3, min3; lia).
  assert (u * v <= (2 ^ 32 + 256) * (2 ^ 32 + 256)) by (apply Z.mul_le_mono_nonneg; lia).
  pose proof (floor_lt (u * v) 256 (2 ^ 31) ltac:(lia)).
  destruct (Z.ltb_spec (u * v / 256) (2 ^ 31)); [| destruct (Z.ltb_spec (u * v) (2 ^ 63))];
    (split; [lia |]); lia.
Qed.

Definition edge_function (a b c : point) (bounds : rect) : list span :=
  cover_in (word_width a b c) 128 a b c bounds.
