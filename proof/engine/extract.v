(* What proof-engine runs: the models in machine words. Without ExtrOcamlZBigInt it is the pure
   build, which has no mapping to trust. *)
From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Rasterproof Require Import Coverage Grid ScanlineWords EdgeFunctionWords OracleWords LineWords.
Extraction "model.ml" scanline_words edge_function_words oracle_words dda_words bresenham_words.
