(** The theorems that join the files: both rasterizers, every triangle, every window. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid Scanline EdgeFunction WordWidth Oracle Lines
  Words ScanlineWords EdgeFunctionWords OracleWords LineWords.
Open Scope Z_scope.

(** Every even number of subpixels, and every word that is wide enough. *)
Theorem rasterizers_agree h bits a b c bounds px py :
  0 < h -> word_is_wide_enough h bits a b c ->
  hits (scanline h a b c bounds) px py = hits (cover_in bits h a b c bounds) px py.
Proof. intros. rewrite scanline_hits, edge_function_hits by assumption. reflexivity. Qed.

(** All corners in i32, 1/256 px, and the word that the engine picks: pixel for pixel the same. *)
Theorem engines_agree a b c bounds px py : in_i32 a -> in_i32 b -> in_i32 c ->
  hits (scanline 128 a b c bounds) px py = hits (edge_function a b c bounds) px py.
Proof. intros. apply rasterizers_agree; [lia | apply word_width_is_enough; assumption]. Qed.

(** And as the oracle, by other mathematics. *)
Theorem engines_equal_oracle a b c bounds px py : in_i32 a -> in_i32 b -> in_i32 c ->
  hits (scanline 128 a b c bounds) px py = hits (oracle 128 a b c bounds) px py /\
  hits (edge_function a b c bounds) px py = hits (oracle 128 a b c bounds) px py.
Proof.
  intros. rewrite <- engines_agree by assumption.
  rewrite scanline_hits, oracle_hits by lia. auto.
Qed.

(** The same of the models in machine words: for all corners and windows of i32 nothing overflows, no
    cast changes a number, and the pixels are the same. *)
Theorem engines_agree_in_words a b c bounds :
  in_i32 a -> in_i32 b -> in_i32 c -> rect_in_i32 bounds ->
  exists s e o, scanline_words a b c bounds = Some s /\ edge_function_words a b c bounds = Some e /\
    oracle_words a b c bounds = Some o /\
    forall px py, hits s px py = hits o px py /\ hits e px py = hits o px py.
Proof.
  intros. exists (scanline 128 a b c bounds), (edge_function a b c bounds), (oracle 128 a b c bounds).
  rewrite scanline_fits, edge_function_fits, oracle_fits by assumption. repeat split;
    apply engines_equal_oracle; assumption.
Qed.

(** And of the line drawers: one list of pixels, in one order. *)
Theorem drawers_agree_in_words a b r : in_i32 a -> in_i32 b -> rect_in_i32 r ->
  exists pixels, dda_words a b r = Some pixels /\ bresenham_words a b r = Some pixels /\
    pixels = filter (in_window r) (line a b).
Proof.
  intros Ha Hb Hr. exists (dda a b r). rewrite dda_fits, bresenham_fits by assumption.
  repeat split; [| apply dda_draws]. rewrite dda_is_bresenham; [reflexivity |].
  unfold in_i32, line_length, max_i64 in *. lia.
Qed.
