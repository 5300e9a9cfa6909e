(** The oracle in the words of its code (crates/oracle/src/coverage.rs): products of 64 bits while the corners
    are near the origin, of 128 bits where they are not. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid EdgeFunction WordWidth Words ScanlineWords EdgeFunctionWords Oracle.
Import ListNotations.
Open Scope Z_scope.

Definition around_words (a b c : point) : option rect :=
  let* xa := fit i32 (X a / 256) in let* xb := fit i32 (X b / 256) in let* xc := fit i32 (X c / 256) in
  let* ya := fit i32 (Y a / 256) in let* yb := fit i32 (Y b / 256) in let* yc := fit i32 (Y c / 256) in
  let* x1 := fit i32 (max3 xa xb xc + 1) in
  let* y1 := fit i32 (max3 ya yb yc + 1) in
  Some (Rect (min3 xa xb xc) (min3 ya yb yc) x1 y1).

(** LeftOf::new and LeftOf::of; T is the word that [times] multiplies in. *)
Definition left_of_words (T : word) (upper lower : point) (x y : Z) : option bool :=
  let* dx := fit i64 (X lower - X upper) in
  let* dy := fit i64 (Y lower - Y upper) in
  let* down := fit i64 (y - Y upper) in
  let* down_dx := fit T (down * dx) in
  let* right := fit i64 (x - X upper) in
  let* product := fit T (right * dy) in
  Some (down_dx <=? product).

Fixpoint count_left_words (T : word) (y : Z) (crossings : list (option (point * point))) (x : Z) : option Z :=
  match crossings with
  | [] => Some 0
  | Some (u, l) :: rest =>
      let* is_left := left_of_words T u l x y in
      let* n := count_left_words T y rest x in
      Some (Z.b2z is_left + n)
  | None :: rest => count_left_words T y rest x
  end.

Fixpoint scan_row_words (count : Z -> option Z) (y_px : Z) (n : nat) (x_px : Z) (start : option Z) :
  option (list span) :=
  match n with
  | O => Some match start with Some x0_px => [(y_px, x0_px, x_px)] | None => [] end
  | S n =>
      let* x := centre_words x_px in
      let* n_left := count x in
      match n_left mod 2 =? 1, start with
      | true, None => scan_row_words count y_px n (x_px + 1) (Some x_px)
      | false, Some x0_px =>
          let* rest := scan_row_words count y_px n (x_px + 1) None in Some ((y_px, x0_px, x_px) :: rest)
      | _, _ => scan_row_words count y_px n (x_px + 1) start
      end
  end.

Fixpoint scan_words (T : word) (a b c : point) (width n : nat) (x_px y_px : Z) : option (list span) :=
  match n with
  | O => Some []
  | S n =>
      let* y := centre_words y_px in
      let crossings := map (crossing y) [(a, b); (b, c); (c, a)] in
      let* row := scan_row_words (count_left_words T y crossings) y_px width x_px None in
      let* rest := scan_words T a b c width n x_px (y_px + 1) in
      Some (row ++ rest)
  end.

Definition oracle_words (a b c : point) (bounds : rect) : option (list span) :=
  let* box := around_words a b c in
  let r := intersect box bounds in
  if (x1 r <=? x0 r) || (y1 r <=? y0 r) then Some []
  else
    let is_near p := Z.max (Z.abs (X p)) (Z.abs (Y p)) <? Z.shiftl 1 29 in
    let T := if is_near a && is_near b && is_near c then i64 else i128 in
    scan_words T a b c (Z.to_nat (x1 r - x0 r)) (Z.to_nat (y1 r - y0 r)) (x0 r) (y0 r).

(** ** It is the model, word for word *)

Definition within (m : Z) (p : point) : Prop := - m <= X p <= m /\ - m <= Y p <= m.

Section Bounded.
Variables (T : word) (m : Z).
Hypotheses (Hm : 0 <= m <= 2 ^ 32) (HL : low T <= - (2 * m * (2 * m))) (HH : 2 * m * (2 * m) <= high T).

Lemma left_of_fits u l x y : within m u -> within m l -> - m <= x <= m -> - m <= y <= m ->
  left_of_words T u l x y = Some (left_of u l x y).
Proof.
  unfold within. intros Hu Hl Hx Hy. unfold left_of_words, left_of.
  assert (P : forall v w, - (2 * m) <= v <= 2 * m -> - (2 * m) <= w <= 2 * m ->
    low T <= v * w <= high T) by (intros; nia).
  do 3 step_word. rewrite (fit_ok T) by (apply P; lia). step_word.
  rewrite (fit_ok T) by (apply P; lia). reflexivity.
Qed.

Lemma count_left_fits a b c x y : within m a -> within m b -> within m c ->
  - m <= x <= m -> - m <= y <= m ->
  let crossings := map (crossing y) [(a, b); (b, c); (c, a)] in
  count_left_words T y crossings x = Some (count_left y crossings x).
Proof.
  intros Ha Hb Hc Hx Hy. unfold count_left, crossing; cbn [map fold_right count_left_words].
  destruct (above a y), (above b y), (above c y); rewrite ?left_of_fits by assumption; reflexivity.
Qed.

Lemma scan_row_fits a b c y y_px n : within m a -> within m b -> within m c -> - m <= y <= m ->
  let crossings := map (crossing y) [(a, b); (b, c); (c, a)] in
  forall x_px start, - m <= centre 128 x_px -> centre 128 (x_px + Z.of_nat n - 1) <= m ->
  - 2 ^ 31 <= x_px -> x_px + Z.of_nat n < 2 ^ 31 ->
  scan_row_words (count_left_words T y crossings) y_px n x_px start =
  Some (scan_row (fun x_px => count_left y crossings (centre 128 x_px) mod 2 =? 1) y_px n x_px start).
Proof.
  intros Ha Hb Hc Hy crossings. induction n as [| n IH]; intros x_px start Hl Hh Rl Rh;
    cbn [scan_row_words scan_row]; [reflexivity |].
  rewrite centre_words_fits by lia. unfold centre in *.
  unfold crossings at 1. rewrite count_left_fits by (try assumption; lia). fold crossings.
  destruct (_ =? 1), start; rewrite IH by lia; reflexivity.
Qed.

Lemma scan_fits a b c width x_px : within m a -> within m b -> within m c ->
  - m <= centre 128 x_px -> centre 128 (x_px + Z.of_nat width - 1) <= m ->
  - 2 ^ 31 <= x_px -> x_px + Z.of_nat width < 2 ^ 31 ->
  forall n y_px, - m <= centre 128 y_px -> centre 128 (y_px + Z.of_nat n - 1) <= m ->
  - 2 ^ 31 <= y_px -> y_px + Z.of_nat n < 2 ^ 31 ->
  scan_words T a b c width n x_px y_px = Some (scan 128 a b c width n x_px y_px).
Proof.
  intros Ha Hb Hc Xl Xh Rl Rh. induction n as [| n IH]; intros y_px Yl Yh Sl Sh;
    cbn [scan_words scan]; [reflexivity |].
  rewrite centre_words_fits by lia.
  assert (centre 128 y_px <= m) by (unfold centre in *; lia).
  rewrite scan_row_fits by (try assumption; lia). rewrite IH by (unfold centre in *; lia). reflexivity.
Qed.
End Bounded.

(** The pixels of the box have their centres as near as the corners, but for a pixel. *)
Lemma around_range m u v w i : - m <= u <= m -> - m <= v <= m -> - m <= w <= m ->
  min3 (u / 256) (v / 256) (w / 256) <= i <= max3 (u / 256) (v / 256) (w / 256) ->
  - (m + 256) <= centre 128 i <= m + 256.
Proof.
  intros Hu Hv Hw Hi. unfold centre, min3, max3 in *.
  pose proof (Z.div_mod u 256 ltac:(lia)). pose proof (Z.mod_pos_bound u 256 ltac:(lia)).
  pose proof (Z.div_mod v 256 ltac:(lia)). pose proof (Z.mod_pos_bound v 256 ltac:(lia)).
  pose proof (Z.div_mod w 256 ltac:(lia)). pose proof (Z.mod_pos_bound w 256 ltac:(lia)).
  lia.
Qed.

Lemma around_fits a b c : in_i32 a -> in_i32 b -> in_i32 c ->
  around_words a b c = Some (around 128 a b c).
Proof.
  unfold in_i32. intros Ha Hb Hc. unfold around_words, around. change (2 * 128) with 256.
  assert (D : forall v, - 2 ^ 31 <= v < 2 ^ 31 -> - 2 ^ 23 <= v / 256 < 2 ^ 23).
  { intros v Hv. split; [apply Z.div_le_lower_bound | apply Z.div_lt_upper_bound]; lia. }
  pose proof (D (X a)). pose proof (D (X b)). pose proof (D (X c)).
  pose proof (D (Y a)). pose proof (D (Y b)). pose proof (D (Y c)). clear D.
  do 6 step_word. unfold max3. do 2 step_word. reflexivity.
Qed.

(** The whole of [Oracle::cover]. *)
Theorem oracle_fits a b c bounds : in_i32 a -> in_i32 b -> in_i32 c -> rect_in_i32 bounds ->
  oracle_words a b c bounds = Some (oracle 128 a b c bounds).
Proof.
  intros Ha Hb Hc HB. unfold oracle_words, oracle. rewrite around_fits by assumption.
  set (r := intersect (around 128 a b c) bounds).
  destruct (Z.leb_spec (x1 r) (x0 r)); cbn [orb]; [reflexivity |].
  destruct (Z.leb_spec (y1 r) (y0 r)); [reflexivity |].
  rewrite Z.shiftl_1_l. set (T := if _ && _ && _ then i64 else i128).
  assert (M : exists m, 0 <= m <= 2 ^ 31 /\ within m a /\ within m b /\ within m c /\
    low T <= - (2 * (m + 256) * (2 * (m + 256))) /\ 2 * (m + 256) * (2 * (m + 256)) <= high T).
  { subst T. unfold in_i32, within in *.
    destruct (Z.ltb_spec (Z.max (Z.abs (X a)) (Z.abs (Y a))) (2 ^ 29)),
      (Z.ltb_spec (Z.max (Z.abs (X b)) (Z.abs (Y b))) (2 ^ 29)),
      (Z.ltb_spec (Z.max (Z.abs (X c)) (Z.abs (Y c))) (2 ^ 29)); cbn [andb].
    1: exists (2 ^ 29). 2-8: exists (2 ^ 31).
    all: cbn [low high i64 i128]; lia. }
  destruct M as (m & Hm & Wa & Wb & Wc & TL & TH). clearbody T.
  assert (RX : forall i, x0 r <= i < x1 r -> - (m + 256) <= centre 128 i <= m + 256).
  { intros i Hi. apply (around_range m (X a) (X b) (X c)); try apply Wa; try apply Wb; try apply Wc.
    cbn [r intersect around x0 x1 y0 y1] in Hi. change (2 * 128) with 256 in Hi. lia. }
  assert (RY : forall i, y0 r <= i < y1 r -> - (m + 256) <= centre 128 i <= m + 256).
  { intros i Hi. apply (around_range m (Y a) (Y b) (Y c)); try apply Wa; try apply Wb; try apply Wc.
    cbn [r intersect around x0 x1 y0 y1] in Hi. change (2 * 128) with 256 in Hi. lia. }
  assert (RI : - 2 ^ 31 <= x0 r /\ x1 r < 2 ^ 31 /\ - 2 ^ 31 <= y0 r /\ y1 r < 2 ^ 31).
  { unfold rect_in_i32 in HB. cbn [r intersect x0 x1 y0 y1]. lia. }
  clearbody r. unfold within in *.
  apply (scan_fits T (m + 256)); unfold within; try lia; rewrite ?Z2Nat.id by lia.
  - apply RX; lia.
  - replace (x0 r + (x1 r - x0 r) - 1) with (x1 r - 1) by lia. apply RX; lia.
  - apply RY; lia.
  - replace (y0 r + (y1 r - y0 r) - 1) with (y1 r - 1) by lia. apply RY; lia.
Qed.
