(** The parameters of the scanline's values (crates/core/src/raster/scanline/values.rs), over the rationals: the
    book's formulas as repaired never leave [0, 1), so there is nothing for a clamp to do. *)
From Coq Require Import ZArith QArith Lia Lqa Bool.
From Rasterproof Require Import Coverage Grid Scanline.
Open Scope Q_scope.

(** The share of u in u + v. Every parameter below is one. *)
Lemma share u v : 0 <= u -> 0 < v -> 0 <= u / (u + v) < 1.
Proof.
  intros Hu Hv. assert (0 < u + v) by lra. split.
  - apply Qle_shift_div_l; lra.
  - apply Qlt_shift_div_r; lra.
Qed.

(** A value between two values. *)
Definition mix (v w t : Q) : Q := v + (w - v) * t.

Lemma mix_in_hull v w t low high : 0 <= t < 1 -> low <= v <= high -> low <= w <= high ->
  low <= mix v w t <= high.
Proof. unfold mix. intros. split; nra. Qed.

(** ** Down an edge: RowEnd::depth and RowEnd::values *)

Section RowEnd.
Variables (a b : point) (y : Z).

Definition below : Q := inject_Z (y - Y a).
Definition above : Q := inject_Z (Y b - y).
Definition height : Q := inject_Z (Y b - Y a).

Definition t_depth : Q := below / height.
Definition q_sum (from_q to_q : Q) : Q := above * from_q + below * to_q.
Definition t (from_q to_q : Q) : Q := below * to_q / q_sum from_q to_q.

Hypothesis Hy : (Y a <= y < Y b)%Z.

Lemma heights : 0 <= below /\ 0 < above /\ 0 < height /\ height == below + above.
Proof.
  unfold below, above, height. repeat split.
  - rewrite <- (Zle_Qle 0). lia.
  - rewrite <- (Zlt_Qlt 0). lia.
  - rewrite <- (Zlt_Qlt 0). lia.
  - rewrite <- inject_Z_plus. f_equiv. lia.
Qed.

Theorem t_depth_in_unit : 0 <= t_depth < 1.
Proof.
  destruct heights as (Hb & Ha & _ & Hs). unfold t_depth. rewrite Hs. apply share; assumption.
Qed.

Theorem t_in_unit from_q to_q : 0 < from_q -> 0 < to_q ->
  0 <= t from_q to_q < 1 /\ 0 < q_sum from_q to_q / height.
Proof.
  intros Hf Ht. destruct heights as (Hb & Ha & Hh & _). unfold t, q_sum.
  assert (0 <= below * to_q) by nra. assert (0 < above * from_q) by nra. split.
  - rewrite (Qplus_comm (above * from_q)). apply share; assumption.
  - apply Qlt_shift_div_l; lra.
Qed.
End RowEnd.

(** ** Along a row: Across *)

(** How far a centre lies right of an edge, in subpixels, times dy. *)
Definition distance (h : Z) (a b : point) (x_px y_px : Z) : Z :=
  (centre h x_px - X a) * (Y b - Y a) - (centre h y_px - Y a) * (X b - X a).

Definition s_depth (from_left from_right left_height right_height : Q) : Q :=
  from_left * right_height / (from_left * right_height + from_right * left_height).

Definition s (from_left from_right left_height right_height left_q right_q : Q) : Q :=
  let l := from_left * (right_height * right_q) in
  let r := from_right * (left_height * left_q) in
  l / (r + l).

(** From the columns of the walk: a pixel of the span is not left of its left edge, and left of its
    right edge. *)
Lemma distance_left h a b px y_px : (0 < h)%Z -> (Y a < Y b)%Z ->
  (column (EdgeWalk_new h a b y_px) <= px)%Z -> (0 <= distance h a b px y_px)%Z.
Proof.
  intros Hh Hab H. apply Z.leb_le in H. rewrite column_left_of in H by assumption.
  unfold left_of in H. apply Z.leb_le in H. unfold distance. lia.
Qed.

Lemma distance_right h a b px y_px : (0 < h)%Z -> (Y a < Y b)%Z ->
  (px < column (EdgeWalk_new h a b y_px))%Z -> (0 < - distance h a b px y_px)%Z.
Proof.
  intros Hh Hab H. apply Z.leb_gt in H. rewrite column_left_of in H by assumption.
  unfold left_of in H. apply Z.leb_gt in H. unfold distance. lia.
Qed.

(** The width of a row is the same number at every column. *)
Theorem width_is_constant h a b c d x_px origin_px y_px :
  (distance h a b origin_px y_px * (Y d - Y c) - distance h c d origin_px y_px * (Y b - Y a) =
   distance h a b x_px y_px * (Y d - Y c) - distance h c d x_px y_px * (Y b - Y a))%Z.
Proof. unfold distance, centre. ring. Qed.

(** Every parameter of every pixel between the left edge from a down to b and the right edge from c
    down to d is in [0, 1): the book's clamps have nothing to do. *)
Theorem parameters_in_unit h a b c d px y_px left_q right_q : (0 < h)%Z ->
  (Y a < Y b)%Z -> (Y c < Y d)%Z ->
  (column (EdgeWalk_new h a b y_px) <= px < column (EdgeWalk_new h c d y_px))%Z ->
  0 < left_q -> 0 < right_q ->
  let from_left := inject_Z (distance h a b px y_px) in
  let from_right := inject_Z (- distance h c d px y_px) in
  let left_height := inject_Z (Y b - Y a) in
  let right_height := inject_Z (Y d - Y c) in
  0 <= s_depth from_left from_right left_height right_height < 1 /\
  0 <= s from_left from_right left_height right_height left_q right_q < 1.
Proof.
  intros Hh Hab Hcd [Hl Hr] Hlq Hrq. cbv zeta.
  pose proof (distance_left h a b px y_px Hh Hab Hl) as Dl.
  pose proof (distance_right h c d px y_px Hh Hcd Hr) as Dr.
  rewrite Zle_Qle in Dl. rewrite Zlt_Qlt in Dr.
  assert (Wl : 0 < inject_Z (Y b - Y a)) by (rewrite <- (Zlt_Qlt 0); lia).
  assert (Wr : 0 < inject_Z (Y d - Y c)) by (rewrite <- (Zlt_Qlt 0); lia).
  change (inject_Z 0) with 0 in *. unfold s_depth, s.
  set (fl := inject_Z (distance h a b px y_px)) in *.
  set (fr := inject_Z (- distance h c d px y_px)) in *.
  set (lh := inject_Z (Y b - Y a)) in *. set (rh := inject_Z (Y d - Y c)) in *.
  clearbody fl fr lh rh. split.
  - apply share; nra.
  - assert (0 < rh * right_q) by nra. assert (0 < lh * left_q) by nra.
    rewrite (Qplus_comm (fr * (lh * left_q))). apply share; nra.
Qed.
