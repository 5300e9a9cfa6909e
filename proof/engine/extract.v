(* What proof-engine runs. Without ExtrOcamlZBigInt it is the pure build: no mapping to trust. *)
From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Rasterproof Require Import Coverage Grid Scanline EdgeFunction WordWidth Lines.
Extraction "model.ml" scanline edge_function inside centre dda bresenham.
