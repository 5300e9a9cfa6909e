(** Pixels, their centres and windows (crates/core/src/grid.rs), for any even number of subpixels S = 2 h; spans
    and how often they hit a pixel. *)
From Coq Require Import ZArith Lia Bool List.
Import ListNotations.
Open Scope Z_scope.

Definition centre (h px : Z) : Z := 2 * h * px + h.

(** ceil((v - h) / S), as the code has it. *)
Definition first_centre (h v : Z) : Z := (v + h - 1) / (2 * h).

(** floor((v + h) / S): one past the last centre at or before v. *)
Definition end_centre (h v : Z) : Z := (v + h) / (2 * h).

Record rect := Rect { x0 : Z; y0 : Z; x1 : Z; y1 : Z }.

Definition in_rect (r : rect) (px py : Z) : bool :=
  ((x0 r <=? px) && (px <? x1 r)) && ((y0 r <=? py) && (py <? y1 r)).

(** Row, first column, one past the last. *)
Definition span := (Z * Z * Z)%type.

Definition in_span (s : span) (px py : Z) : bool :=
  let '(y, a, b) := s in (y =? py) && ((a <=? px) && (px <? b)).

(** How often a list of spans hits a pixel. *)
Fixpoint hits (spans : list span) (px py : Z) : Z :=
  match spans with
  | [] => 0
  | s :: rest => Z.b2z (in_span s px py) + hits rest px py
  end.

Lemma hits_app s t px py : hits (s ++ t) px py = hits s px py + hits t px py.
Proof. induction s as [| a s IH]; cbn; [| rewrite IH]; lia. Qed.

(** A row and the rows below it. *)
Lemma row_by_row y py n c : 0 <= n ->
  Z.b2z ((y =? py) && c) + Z.b2z (((y + 1 <=? py) && (py <? y + 1 + n)) && c) =
  Z.b2z (((y <=? py) && (py <? y + 1 + n)) && c).
Proof.
  intros. destruct (Z.eqb_spec y py), (Z.leb_spec (y + 1) py), (Z.ltb_spec py (y + 1 + n)),
    (Z.leb_spec y py); cbn [andb Z.b2z]; lia.
Qed.

(** ** Floor division *)

Lemma floor_le n d i : 0 < d -> (i <= n / d <-> d * i <= n).
Proof.
  intros. split; intros.
  - pose proof (Z.mul_div_le n d). nia.
  - apply Z.div_le_lower_bound; assumption.
Qed.

Lemma floor_lt n d i : 0 < d -> (n / d < i <-> n < d * i).
Proof. intros Hd. pose proof (floor_le n d i Hd). lia. Qed.

Lemma floor_shift n d i : 0 < d -> (n + d * i) / d = n / d + i.
Proof. intros. rewrite Z.mul_comm, Z.div_add by lia. reflexivity. Qed.

Lemma first_centre_le h v i : 0 < h -> (first_centre h v <= i <-> v <= centre h i).
Proof.
  intros. unfold first_centre, centre.
  pose proof (floor_lt (v + h - 1) (2 * h) (i + 1)). lia.
Qed.

Lemma end_centre_lt h v i : 0 < h -> (i < end_centre h v <-> centre h i <= v).
Proof.
  intros. unfold end_centre, centre.
  pose proof (floor_le (v + h) (2 * h) (i + 1)). lia.
Qed.
