(** The values of a pixel, operation by operation, as crates/core/src/raster/edge_function/values.rs,
    crates/core/src/raster/scanline/values.rs, crates/core/src/line/dda.rs and crates/core/src/line/bresenham.rs compute
    them. [fl] is what each operation does to its exact result. [Nearest] has the rounding of f64; [RoundedValues] states
    how far the results are from the exact ones. *)
From Coq Require Import ZArith QArith.
Open Scope Q_scope.

Section Model.
Variable fl : Q -> Q.

Notation "! z" := (inject_Z z) (at level 5, format "! z").

(** v + (w - v) t, as an edge, a row and a line compute it. *)
Definition between (v w t : Q) : Q := fl (v + fl (fl (w - v) * t)).

(** 1/w of a vertex over the largest of the three. *)
Definition relative (largest w : Q) : Q := fl (w / largest).

(** ** The edge-function engine: Values::fill *)

(** v0 + (a1 (v1 - v0) + a2 (v2 - v0)) r. *)
Definition offset (v0 v1 v2 a1 a2 r : Q) : Q :=
  fl (v0 + fl (fl (fl (fl (v1 - v0) * a1) + fl (fl (v2 - v0) * a2)) * r)).

Definition edge_depth (e0 e1 e2 : Z) (z0 z1 z2 : Q) : Q :=
  offset z0 z1 z2 (fl !e1) (fl !e2) (fl (1 / fl !(e0 + e1 + e2))).

(** The weight of a vertex. *)
Definition edge_weight (largest : Q) (e : Z) (w : Q) : Q := fl (fl !e * relative largest w).

Definition edge_attribute (e0 e1 e2 : Z) (w0 w1 w2 largest : Q) (v0 v1 v2 : Q) : Q :=
  offset v0 v1 v2 (edge_weight largest e1 w1) (edge_weight largest e2 w2)
    (fl (1 / fl (fl (edge_weight largest e0 w0 + edge_weight largest e1 w1) + edge_weight largest e2 w2))).

(** ** Lines *)

(** At pixel i of n. *)
Definition line_value (i n : Z) (a b : Q) : Q := between a b (fl (!i / !n)).

(** ** The scanline engine *)

(** Down an edge: a row of centres lies [below] under its upper end and [above] over its lower one, and the relative
    1/w of the ends are qa and qb. RowEnd::depth and RowEnd::values. *)
Definition row_depth (below height : Z) (za zb : Q) : Q := between za zb (fl (!below / !height)).

Definition row_sum (below above : Z) (qa qb : Q) : Q := fl (fl (!above * qa) + fl (!below * qb)).

Definition row_value (below above : Z) (qa qb va vb : Q) : Q :=
  between va vb (fl (fl (!below * qb) / row_sum below above qa qb)).

(** Mix::new: the relative 1/w there, times the height. *)
Definition row_q (below above height : Z) (qa qb : Q) : Q :=
  fl (!height * fl (row_sum below above qa qb / !height)).

(** Along a row, with l and r the distances to its left and right edge. Across::varying. *)
Definition row_place (l r : Z) (ql qr : Q) : Q :=
  let x := fl (fl !l * qr) in let y := fl (fl !r * ql) in fl (x * fl (1 / fl (y + x))).

(** Across::depth, whose width is taken where the distances are l0 and r0. *)
Definition depth_place (l l0 r0 hl hr : Z) : Q :=
  fl (fl !l * fl (!hr * fl (1 / fl (fl (fl !l0 * !hr) + fl (fl !r0 * !hl))))).

Definition scanline_depth (l below1 height1 below2 height2 l0 r0 : Z) (za zb zc zd : Q) : Q :=
  between (row_depth below1 height1 za zb) (row_depth below2 height2 zc zd) (depth_place l l0 r0 height1 height2).

Definition scanline_attribute (l r below1 above1 height1 below2 above2 height2 : Z) (wa wb wc wd largest : Q)
    (va vb vc vd : Q) : Q :=
  let qa := relative largest wa in let qb := relative largest wb in
  let qc := relative largest wc in let qd := relative largest wd in
  between (row_value below1 above1 qa qb va vb) (row_value below2 above2 qc qd vc vd)
    (row_place l r (row_q below1 above1 height1 qa qb) (row_q below2 above2 height2 qc qd)).
End Model.
