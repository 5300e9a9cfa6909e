(* What proof-values runs: the values of a pixel in rounded operations. *)
From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Rasterproof Require Import Coverage EngineValues PlaneModel.
Extraction "values_model.ml" rounded_edge_function rounded_scanline rounded_inverse tile_values.
