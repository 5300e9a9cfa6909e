(* What search runs beside its own floats: the models whose errors it looks for. *)
From Coq Require Import ZArith QArith Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Rasterproof Require Import Coverage Nearest RoundedModel RoundedFilters PlaneModel DepthKeys.
Definition edge_estimate := estimate nearest.
Definition edge_limit := edge_bound nearest.
(* The centre of the column, and the ends of what is not decided. *)
Definition row_crossing (ax ay bx b_y yc : Q) : Q * Q :=
  let t := quotient nearest ax ay bx b_y yc in let x := crossing nearest ax ay bx b_y yc in
  let error := crossing_bound nearest x t in (lowest nearest x error, highest nearest x error).
Definition row_depth_place := depth_place nearest.
(* A plane at a pixel, and its bound. *)
Definition plane_with_bound (f : frame) (width height : Z) (c0 c1 c2 x y : Q) : Q * Q :=
  let p := plane_of f c0 c1 c2 in
  (plane_at p x y, computed_error 4 11 18 126 (computed_size (at_start p) (to_right p) (to_below p) x y)
    (size_of c0 c1 c2 (growth_of f width height))).
Definition quotient_with_bound (n en q eq : Q) : Q * Q := (computed_quotient n q, computed_quotient_error 2 18 126 en eq n q).
Definition key24 : Q -> Z := key 3 20 (2 ^ 24 - 1).
Extraction "search_model.ml" edge_estimate edge_limit row_crossing row_depth_place frame_of plane_with_bound
  quotient_with_bound nearest key24.
