(** The oracle (crates/oracle/src/coverage.rs), loop by loop: the box around the corners, the edges that
    cross a row, and the runs of samples with an odd number of them to the left. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid EdgeFunction.
Import ListNotations.
Open Scope Z_scope.

(** All pixels whose squares touch the bounding box of the corners. *)
Definition around (h : Z) (a b c : point) : rect :=
  let low sub := sub / (2 * h) in
  Rect (min3 (low (X a)) (low (X b)) (low (X c))) (min3 (low (Y a)) (low (Y b)) (low (Y c)))
       (max3 (low (X a)) (low (X b)) (low (X c)) + 1) (max3 (low (Y a)) (low (Y b)) (low (Y c)) + 1).

Definition intersect (r s : rect) : rect :=
  Rect (Z.max (x0 r) (x0 s)) (Z.max (y0 r) (y0 s)) (Z.min (x1 r) (x1 s)) (Z.min (y1 r) (y1 s)).

(** An edge that crosses the height of the nudged samples, upper end first. *)
Definition crossing (y : Z) (e : point * point) : option (point * point) :=
  let '(a, b) := e in
  match above a y, above b y with
  | true, false => Some (a, b)
  | false, true => Some (b, a)
  | _, _ => None
  end.

Definition count_left (y : Z) (crossings : list (option (point * point))) (x : Z) : Z :=
  fold_right (fun edge n =>
    match edge with Some (u, l) => Z.b2z (left_of u l x y) + n | None => n end) 0 crossings.

(** One row from column x on, n columns; [start] is the first column of a run that is not over. *)
Fixpoint scan_row (odd : Z -> bool) (y_px : Z) (n : nat) (x_px : Z) (start : option Z) : list span :=
  match n with
  | O => match start with Some x0_px => [(y_px, x0_px, x_px)] | None => [] end
  | S n =>
      match odd x_px, start with
      | true, None => scan_row odd y_px n (x_px + 1) (Some x_px)
      | false, Some x0_px => (y_px, x0_px, x_px) :: scan_row odd y_px n (x_px + 1) None
      | _, _ => scan_row odd y_px n (x_px + 1) start
      end
  end.

Fixpoint scan (h : Z) (a b c : point) (width n : nat) (x_px y_px : Z) : list span :=
  match n with
  | O => []
  | S n =>
      let y := centre h y_px in
      let crossings := map (crossing y) [(a, b); (b, c); (c, a)] in
      scan_row (fun x_px => count_left y crossings (centre h x_px) mod 2 =? 1) y_px width x_px None ++
      scan h a b c width n x_px (y_px + 1)
  end.

Definition oracle (h : Z) (a b c : point) (bounds : rect) : list span :=
  let r := intersect (around h a b c) bounds in
  if (x1 r <=? x0 r) || (y1 r <=? y0 r) then []
  else scan h a b c (Z.to_nat (x1 r - x0 r)) (Z.to_nat (y1 r - y0 r)) (x0 r) (y0 r).

(** ** What it covers *)

Lemma odd_is_inside a b c x y :
  (count_left y (map (crossing y) [(a, b); (b, c); (c, a)]) x mod 2 =? 1) = inside a b c x y.
Proof.
  unfold inside, crosses, count_left, crossing; cbn [map fold_right].
  destruct (above a y), (above b y), (above c y); try reflexivity;
    repeat match goal with |- context [left_of ?p ?q x y] => destruct (left_of p q x y) end; reflexivity.
Qed.

Lemma hits_scan_row odd y qx qy n : forall x start,
  (forall x0, start = Some x0 -> x0 < x) ->
  hits (scan_row odd y n x start) qx qy =
  Z.b2z ((y =? qy) && (((x <=? qx) && (qx <? x + Z.of_nat n)) && odd qx ||
    match start with Some x0 => (x0 <=? qx) && (qx <? x) | None => false end)).
Proof.
  induction n as [| n IH]; intros x start Hs; cbn [scan_row].
  - destruct start as [s |]; cbn [hits in_span];
      destruct (odd qx); decide_all; cbn [andb orb Z.b2z]; lia.
  - replace (x + Z.of_nat (S n)) with (x + 1 + Z.of_nat n) by lia.
    destruct (odd x) eqn:O, start as [s |]; try (pose proof (Hs s eq_refl));
      cbn [hits in_span]; rewrite IH by (intros ? [= <-]; lia) || rewrite IH by (intros ? [=]);
      (destruct (Z.eq_dec qx x) as [-> |]; [rewrite O | destruct (odd qx)]);
      decide_all; cbn [andb orb Z.b2z]; lia.
Qed.

Lemma hits_scan h a b c width x qx qy n : forall y,
  hits (scan h a b c width n x y) qx qy =
  Z.b2z (((y <=? qy) && (qy <? y + Z.of_nat n)) && (((x <=? qx) && (qx <? x + Z.of_nat width)) &&
         inside a b c (centre h qx) (centre h qy))).
Proof.
  induction n as [| n IH]; intros y; cbn [scan].
  - cbn [hits]. destruct (inside _ _ _ _ _); decide_all; cbn; lia.
  - rewrite hits_app, IH, hits_scan_row by discriminate.
    replace (y + Z.of_nat (S n)) with (y + 1 + Z.of_nat n) by lia.
    rewrite <- row_by_row by lia. f_equal. f_equal. rewrite orb_false_r, odd_is_inside.
    destruct (Z.eqb_spec y qy) as [-> |]; reflexivity.
Qed.

(** The squares of the corners surround every centre between them. *)
Lemma lows_around h u v w i : 0 < h -> min3 u v w <= centre h i <= max3 u v w ->
  min3 (u / (2 * h)) (v / (2 * h)) (w / (2 * h)) <= i < max3 (u / (2 * h)) (v / (2 * h)) (w / (2 * h)) + 1.
Proof.
  intros Hh [L U].
  assert (F : forall v, v <= centre h i -> v / (2 * h) <= i)
    by (intros z Hz; pose proof (floor_lt z (2 * h) (i + 1)); unfold centre in *; lia).
  assert (G : forall v, centre h i <= v -> i <= v / (2 * h))
    by (intros z Hz; apply floor_le; unfold centre in *; lia).
  unfold min3, max3 in *. split.
  - assert (u <= centre h i \/ v <= centre h i \/ w <= centre h i) as [H | [H | H]] by lia;
      apply F in H; lia.
  - assert (centre h i <= u \/ centre h i <= v \/ centre h i <= w) as [H | [H | H]] by lia;
      apply G in H; lia.
Qed.

(** The oracle hits every pixel of the window whose centre is inside, once: the runs and the box
    neither add to the parity of crossings nor take away from it. *)
Theorem oracle_hits h a b c bounds px py : 0 < h ->
  hits (oracle h a b c bounds) px py =
  Z.b2z (in_rect bounds px py && inside a b c (centre h px) (centre h py)).
Proof.
  intros Hh. unfold oracle. set (r := intersect _ _).
  assert (Box : in_rect bounds px py && inside a b c (centre h px) (centre h py) =
    in_rect r px py && inside a b c (centre h px) (centre h py)).
  { destruct (inside a b c (centre h px) (centre h py)) eqn:C;
      [rewrite !andb_true_r | rewrite !andb_false_r; reflexivity].
    apply inside_in_box in C as [Bx By].
    apply (lows_around h) in Bx, By; try assumption.
    apply eq_true_iff_eq. unfold in_rect. rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt.
    cbn [r intersect around x0 x1 y0 y1]. lia. }
  rewrite Box. clear Box. clearbody r.
  destruct (Z.leb_spec (x1 r) (x0 r)); cbn [orb]; [| destruct (Z.leb_spec (y1 r) (y0 r))].
  1, 2: cbn [hits]; unfold in_rect;
    match goal with |- 0 = Z.b2z ?b => destruct b eqn:C; [exfalso | reflexivity] end;
    rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in C; lia.
  rewrite hits_scan, !Z2Nat.id by lia.
  replace (y0 r + (y1 r - y0 r)) with (y1 r) by lia.
  replace (x0 r + (x1 r - x0 r)) with (x1 r) by lia.
  unfold in_rect. f_equal. rewrite andb_assoc. f_equal. apply andb_comm.
Qed.
