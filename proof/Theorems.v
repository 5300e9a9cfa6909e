(** The theorems that join the files: both rasterizers, every triangle, every window. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid Scanline EdgeFunction WordWidth Mesh Fan Lines.
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
