(** The scanline engine in the words of its code (crates/core/src/raster/scanline.rs), line by line: no operation
    overflows and no cast changes a number, for all corners and windows in i32. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid Scanline WordWidth Words.
Import ListNotations.
Open Scope Z_scope.

Definition first_centre_words (sub : Z) : option Z :=
  let* n := fit i64 (sub + 127) in fit i32 (Z.shiftr n 8).

Definition centre_words (px : Z) : option Z :=
  let* n := fit i64 (Z.shiftl px 8) in fit i64 (n + 128).

Definition floor_div_words (n d : Z) : option (Z * Z) :=
  let word := if is_in i32 n && is_in i32 d && (0 <? d) then i32 else i64 in
  let* quotient := fit word (Z.quot n d) in
  let* remainder := fit word (Z.rem n d) in
  let borrow := Z.shiftr remainder 63 in
  let* q := fit i64 (quotient + borrow) in
  let* r := fit i64 (remainder + Z.land d borrow) in
  Some (q, r).

Definition EdgeWalk_new_words (a b : point) (y_px : Z) : option EdgeWalk :=
  let* dx := fit i64 (X b - X a) in
  let* dy := fit i64 (Y b - Y a) in
  let* yc := centre_words y_px in
  let* down := fit i64 (yc - Y a) in
  let base := Z.shiftr (X a) 8 in
  let* ax := fit i64 (Z.land (X a) 255 - 128) in
  let* abs_dx := fit i64 (Z.abs dx) in
  let* numerator :=
    if Z.max abs_dx dy <? Z.shiftl 1 30 then
      let* p := fit i64 (ax * dy) in
      let* q := fit i64 (down * dx) in
      let* n := fit i64 (p + q) in
      let* n := fit i64 (n + 255) in
      Some (Z.shiftr n 8)
    else
      let* p := fit i128 (ax * dy) in
      let* q := fit i128 (down * dx) in
      let* n := fit i128 (p + q) in
      let* n := fit i128 (n + 255) in
      fit i64 (Z.shiftr n 8) in
  let* minus_numerator := fit i64 (- numerator) in
  let* (minus_column, remainder) := floor_div_words minus_numerator dy in
  let* (step_whole, step_part) := floor_div_words dx dy in
  let* column := fit i64 (base - minus_column) in
  Some (Walk column remainder step_whole step_part dy).

Definition step_words (w : EdgeWalk) : option EdgeWalk :=
  let* r := fit i64 (remainder w - step_part w) in
  let carry := Z.shiftr r 63 in
  let* by_columns := fit i64 (step_whole w - carry) in
  let* column := fit i64 (column w + by_columns) in
  let* r := fit i64 (r + Z.land (dy w) carry) in
  Some (Walk column r (step_whole w) (step_part w) (dy w)).

(** y, then x, in one number that compares as the pair does. *)
Definition key (p : point) : option Z :=
  let* y := fit i64 (Z.shiftl (Y p) 32) in
  let* x := fit u32 (Z.abs (X p - -2147483648)) in
  fit i64 (Z.lor y x).

Definition sort_words (a b : point) : option (point * point) :=
  let* ka := key a in
  let* kb := key b in
  Some (if kb <? ka then (b, a) else (a, b)).

Definition sort_by_height_words (a b c : point) : option (point * point * point) :=
  let* (a, b) := sort_words a b in
  let* (b, c) := sort_words b c in
  let* (a, b) := sort_words a b in
  Some (a, b, c).

Section Rows.
Variables (middle bottom : point) (turn x_low x_high : Z).

Definition row_span_words (y_px : Z) (long short : EdgeWalk) : option (list span) :=
  let first := Z.min (column long) (column short) in
  let x0 := Z.max first x_low in
  let x1 := Z.min (Z.max (column long) (column short)) x_high in
  if x0 <? x1 then
    let* x0_px := fit i32 x0 in
    let* x1_px := fit i32 x1 in
    let* first_px := fit i32 first in
    Some [(y_px, x0_px, x1_px)]
  else Some [].

Fixpoint walk_words (n : nat) (y_px : Z) (long short : EdgeWalk) : option (list span) :=
  match n with
  | O => Some []
  | S n =>
      let* short := if y_px =? turn then EdgeWalk_new_words middle bottom y_px else Some short in
      let* row := row_span_words y_px long short in
      let* long := step_words long in
      let* short := step_words short in
      let* rest := walk_words n (y_px + 1) long short in
      Some (row ++ rest)
  end.
End Rows.

Definition scanline_words (a b c : point) (bounds : rect) : option (list span) :=
  let* (top, middle, bottom) := sort_by_height_words a b c in
  let* first := first_centre_words (Y top) in
  let* split := first_centre_words (Y middle) in
  let* endd := first_centre_words (Y bottom) in
  let ya := Z.max first (y0 bounds) in
  let yb := Z.min endd (y1 bounds) in
  if (yb <=? ya) || (x1 bounds <=? x0 bounds) then Some []
  else
    let* long := EdgeWalk_new_words top bottom ya in
    let starts_low := split <=? ya in
    let turn := if starts_low then yb else split in
    let* short :=
      EdgeWalk_new_words (if starts_low then middle else top) (if starts_low then bottom else middle) ya in
    walk_words middle bottom turn (x0 bounds) (x1 bounds) (Z.to_nat (yb - ya)) ya long short.

(** ** It is the model, word for word *)

Lemma first_centre_fits p : - 2 ^ 31 <= p < 2 ^ 31 ->
  first_centre_words p = Some (first_centre 128 p) /\ - 2 ^ 23 <= first_centre 128 p <= 2 ^ 23.
Proof.
  intros H. unfold first_centre_words. step_word. rewrite shift_8.
  assert (R : - 2 ^ 23 <= first_centre 128 p <= 2 ^ 23)
    by (pose proof (first_centre_le 128 p (2 ^ 23)); pose proof (first_centre_le 128 p (- 2 ^ 23 - 1));
        unfold centre in *; lia).
  replace ((p + 127) / 256) with (first_centre 128 p) by (unfold first_centre; f_equal; lia).
  split; [| exact R]. step_word. reflexivity.
Qed.

Lemma centre_fits px : - 2 ^ 31 <= px < 2 ^ 31 -> centre_words px = Some (centre 128 px).
Proof.
  intros H. unfold centre_words. rewrite Z.shiftl_mul_pow2 by lia. change (2 ^ 8) with 256.
  step_word. step_word. unfold centre. f_equal. lia.
Qed.

Lemma floor_div_fits n d : - 2 ^ 62 <= n <= 2 ^ 62 -> 0 < d < 2 ^ 32 ->
  floor_div_words n d = Some (floor_div n d).
Proof.
  intros Hn Hd. unfold floor_div_words, floor_div.
  pose proof (Z.quot_rem n d ltac:(lia)) as QR. pose proof (Z.rem_bound_abs n d ltac:(lia)).
  assert (Q : Z.abs (Z.quot n d) <= Z.abs n)
    by (rewrite <- Z.quot_abs by lia; rewrite Z.quot_div_nonneg by lia;
        apply Z.div_le_upper_bound; [lia |]; nia).
  set (word := if _ && _ && _ then i32 else i64).
  assert (W : low word <= Z.quot n d <= high word /\ low word <= Z.rem n d <= high word).
  { subst word. unfold is_in. destruct (Z.leb_spec (low i32) n), (Z.leb_spec n (high i32)),
      (Z.leb_spec (low i32) d), (Z.leb_spec d (high i32)), (Z.ltb_spec 0 d);
      cbn [andb low high i32 i64] in *; try lia. }
  clearbody word. rewrite !fit_ok by apply W.
  set (q := Z.quot n d) in *. set (r := Z.rem n d) in *. clearbody q r. clear W.
  rewrite sign_mask, sign_bit by fits_word.
  destruct (Z.ltb_spec r 0); step_word; step_word; f_equal; f_equal; lia.
Qed.

Theorem EdgeWalk_new_fits a b y_px : in_i32 a -> in_i32 b -> Y a <= centre 128 y_px < Y b ->
  EdgeWalk_new_words a b y_px = Some (EdgeWalk_new 128 a b y_px).
Proof.
  unfold in_i32. intros Ha Hb Hy. unfold EdgeWalk_new_words, EdgeWalk_new.
  change (2 * 128) with 256. rewrite centre_fits by (unfold centre in Hy; lia).
  rewrite shift_8, mask_8. set (yc := centre 128 y_px) in *. clearbody yc.
  pose proof (Z.mod_pos_bound (X a) 256 ltac:(lia)).
  pose proof (Z.div_mod (X a) 256 ltac:(lia)).
  set (base := X a / 256) in *. set (ax := X a mod 256 - 128).
  assert (-128 <= ax <= 127) by (unfold ax; lia).
  replace (X a mod 256 - 128) with ax by reflexivity.
  set (d := Y b - Y a). set (e := X b - X a). set (down := yc - Y a).
  assert (0 < d < 2 ^ 32) by (unfold d; lia). assert (- 2 ^ 32 < e < 2 ^ 32) by (unfold e; lia).
  assert (0 <= down < d) by (unfold down, d; lia).
  assert (base * 256 <= X a < base * 256 + 256) by lia.
  clearbody d e down ax base. do 5 step_word.
  assert (P : - 2 ^ 39 <= ax * d <= 2 ^ 39) by nia.
  assert (Q : - 2 ^ 64 < down * e < 2 ^ 64) by nia.
  set (n := ax * d + down * e).
  assert (N : - 2 ^ 57 <= (n + 255) / 256 <= 2 ^ 57).
  { split; [apply Z.div_le_lower_bound | apply Z.div_le_upper_bound]; unfold n; lia. }
  match goal with |- context [let* numerator := ?m in _] =>
    replace m with (Some ((n + 255) / 256)) end.
  2: { rewrite Z.shiftl_1_l. destruct (Z.ltb_spec (Z.max (Z.abs e) d) (2 ^ 30)).
       - assert (- 2 ^ 60 <= down * e <= 2 ^ 60) by nia.
         do 4 step_word. rewrite shift_8. reflexivity.
       - do 4 step_word. rewrite shift_8. fold n. step_word. reflexivity. }
  replace (n + (256 - 1)) with (n + 255) by lia.
  set (m := (n + 255) / 256) in *. clearbody m. clear n P Q.
  step_word. rewrite !floor_div_fits by lia.
  rewrite !floor_div_spec by lia.
  assert (- 2 ^ 57 - 1 <= - m / d <= 2 ^ 57)
    by (split; [apply Z.div_le_lower_bound | apply Z.div_le_upper_bound]; nia).
  step_word. reflexivity.
Qed.

(** Every column of a row that the edge crosses lies in the domain. *)
Lemma column_range a b y_px : in_i32 a -> in_i32 b -> Y a <= centre 128 y_px < Y b ->
  - 2 ^ 23 <= column (EdgeWalk_new 128 a b y_px) <= 2 ^ 23.
Proof.
  unfold in_i32. intros Ha Hb Hy.
  pose proof (column_left_of 128 a b (2 ^ 23) y_px ltac:(lia) ltac:(lia)) as R.
  pose proof (column_left_of 128 a b (- 2 ^ 23 - 1) y_px ltac:(lia) ltac:(lia)) as L.
  set (yc := centre 128 y_px) in *. clearbody yc. unfold left_of, centre in R, L.
  set (d := Y b - Y a) in *. set (e := X b - X a) in *. set (down := yc - Y a) in *.
  assert (T : down * e <= d * Z.max e 0 /\ d * Z.min e 0 <= down * e) by (unfold down, d, e; nia).
  split.
  - apply Z.lt_pred_le, Z.leb_gt. rewrite <- Z.sub_1_r, L. apply Z.leb_gt.
    assert (2 * 128 * (- 2 ^ 23 - 1) + 128 - X a < Z.min e 0) by (unfold e; lia).
    apply Z.lt_le_trans with (Z.min e 0 * d); [apply Z.mul_lt_mono_pos_r; unfold d; lia | lia].
  - apply Z.leb_le. rewrite R. apply Z.leb_le.
    assert (Z.max e 0 <= 2 * 128 * 2 ^ 23 + 128 - X a) by (unfold e; lia).
    apply Z.le_trans with (Z.max e 0 * d); [lia |].
    apply Z.mul_le_mono_nonneg_r; unfold d; lia.
Qed.

Lemma step_fits a b y_px : in_i32 a -> in_i32 b -> Y a <= centre 128 y_px < Y b ->
  step_words (EdgeWalk_new 128 a b y_px) = Some (EdgeWalk_new 128 a b (y_px + 1)).
Proof.
  intros Ha Hb Hy. pose proof (column_range a b y_px Ha Hb Hy) as C.
  pose proof (remainder_range 128 a b y_px ltac:(lia)) as R. unfold in_i32 in *.
  rewrite <- step_is_new by lia.
  assert (F : step_whole (EdgeWalk_new 128 a b y_px) = (X b - X a) / (Y b - Y a) /\
    step_part (EdgeWalk_new 128 a b y_px) = (X b - X a) mod (Y b - Y a) /\
    dy (EdgeWalk_new 128 a b y_px) = Y b - Y a)
    by (rewrite EdgeWalk_new_spec by lia; auto).
  destruct F as (Fw & Fp & Fd).
  pose proof (Z.mod_pos_bound (X b - X a) (Y b - Y a) ltac:(lia)) as M. rewrite <- Fp, <- Fd in M.
  assert (W : - 2 ^ 32 <= step_whole (EdgeWalk_new 128 a b y_px) <= 2 ^ 32).
  { rewrite Fw. split; [apply Z.div_le_lower_bound | apply Z.div_le_upper_bound]; nia. }
  assert (D : 0 < dy (EdgeWalk_new 128 a b y_px) < 2 ^ 32) by lia.
  clear Fw Fp Fd Hy. set (w := EdgeWalk_new 128 a b y_px) in *. clearbody w.
  unfold step_words, step. step_word. rewrite sign_mask, sign_bit by fits_word.
  destruct (Z.ltb_spec (remainder w - step_part w) 0); do 3 step_word; f_equal; f_equal; lia.
Qed.

(** The order of the corners: one number compares as the pair of y and x. *)
Lemma sort_fits a b : in_i32 a -> in_i32 b -> sort_words a b = Some (if before b a then (b, a) else (a, b)).
Proof.
  unfold in_i32. intros Ha Hb. unfold sort_words, key.
  rewrite !Z.shiftl_mul_pow2 by lia. change (2 ^ 32) with 4294967296.
  do 2 step_word.
  rewrite (fit_ok i64 (Y b * 4294967296)), (fit_ok u32 (Z.abs (X b - -2147483648))) by fits_word.
  change 4294967296 with (2 ^ 32). rewrite <- !Z.shiftl_mul_pow2, !pack_32 by lia.
  do 2 step_word. f_equal.
  match goal with |- (if ?p then _ else _) = _ => replace p with (before b a); [reflexivity |] end.
  unfold before. apply eq_true_iff_eq.
  rewrite orb_true_iff, andb_true_iff, !Z.ltb_lt, Z.eqb_eq. lia.
Qed.

Lemma sort_by_height_fits a b c : in_i32 a -> in_i32 b -> in_i32 c ->
  sort_by_height_words a b c = Some (sort_by_height a b c).
Proof.
  intros Ha Hb Hc. unfold sort_by_height_words, sort_by_height. rewrite sort_fits by assumption.
  destruct (before b a); rewrite sort_fits by assumption;
    match goal with |- context [if before ?p ?q then _ else _] => destruct (before p q) end;
    rewrite sort_fits by assumption;
    match goal with |- context [if before ?p ?q then _ else _] => destruct (before p q) end; reflexivity.
Qed.

Lemma sort_keeps (P : point -> Prop) a b c : P a -> P b -> P c ->
  let '(top, middle, bottom) := sort_by_height a b c in P top /\ P middle /\ P bottom.
Proof.
  intros. unfold sort_by_height.
  repeat match goal with |- context [if before ?p ?q then _ else _] => destruct (before p q) end; auto.
Qed.

Definition rect_in_i32 (r : rect) : Prop :=
  - 2 ^ 31 <= x0 r < 2 ^ 31 /\ - 2 ^ 31 <= y0 r < 2 ^ 31 /\
  - 2 ^ 31 <= x1 r < 2 ^ 31 /\ - 2 ^ 31 <= y1 r < 2 ^ 31.

Lemma walk_fits top middle bottom turn x_low x_high :
  in_i32 top -> in_i32 middle -> in_i32 bottom -> Y top <= Y middle <= Y bottom ->
  - 2 ^ 31 <= x_low < 2 ^ 31 -> - 2 ^ 31 <= x_high < 2 ^ 31 ->
  forall n y short,
  Y top <= centre 128 y -> (n <> O -> centre 128 (y + Z.of_nat n - 1) < Y bottom) ->
  (turn = first_centre 128 (Y middle) \/
   first_centre 128 (Y middle) <= y /\ y + Z.of_nat n <= turn) ->
  (y = turn \/ short = if Y middle <=? centre 128 y then EdgeWalk_new 128 middle bottom y
                       else EdgeWalk_new 128 top middle y) ->
  walk_words middle bottom turn x_low x_high n y (EdgeWalk_new 128 top bottom y) short =
  Some (walk 128 middle bottom turn x_low x_high n y (EdgeWalk_new 128 top bottom y) short).
Proof.
  intros It Im Ib Hs Hl Hh. induction n as [| n IH]; intros y short Hy Hn Ht Hshort; [reflexivity |].
  cbn [walk_words walk].
  assert (Hc : centre 128 (y + 1) = centre 128 y + 256) by (unfold centre; ring).
  assert (Hyb : centre 128 y < Y bottom) by (unfold centre in *; lia).
  pose proof (first_centre_le 128 (Y middle) y ltac:(lia)) as F0.
  pose proof (first_centre_le 128 (Y middle) (y + 1) ltac:(lia)) as F1.
  set (other := if Y middle <=? centre 128 y then middle else top).
  set (lower := if Y middle <=? centre 128 y then bottom else middle).
  assert (O : in_i32 other /\ in_i32 lower /\ Y other <= centre 128 y < Y lower)
    by (subst other lower; destruct (Z.leb_spec (Y middle) (centre 128 y)); repeat split; try apply Im;
        try apply Ib; try apply It; lia).
  assert (S1 : (if y =? turn then EdgeWalk_new_words middle bottom y else Some short) =
               Some (EdgeWalk_new 128 other lower y) /\
               (if y =? turn then EdgeWalk_new 128 middle bottom y else short) =
               EdgeWalk_new 128 other lower y).
  { subst other lower. destruct (Z.eqb_spec y turn) as [E |].
    - destruct (Z.leb_spec (Y middle) (centre 128 y)); [| lia].
      rewrite EdgeWalk_new_fits by (try assumption; lia). auto.
    - destruct Hshort as [| ->]; [lia |]. destruct (Y middle <=? centre 128 y); auto. }
  destruct S1 as [-> ->]. destruct O as (Io & Il & Ho).
  pose proof (column_range top bottom y It Ib ltac:(lia)) as C1.
  pose proof (column_range other lower y Io Il Ho) as C2.
  assert (Row : row_span_words x_low x_high y (EdgeWalk_new 128 top bottom y) (EdgeWalk_new 128 other lower y) =
    Some (row_span x_low x_high y (EdgeWalk_new 128 top bottom y) (EdgeWalk_new 128 other lower y))).
  { unfold row_span_words, row_span.
    set (c1 := column (EdgeWalk_new 128 top bottom y)) in *.
    set (c2 := column (EdgeWalk_new 128 other lower y)) in *. clearbody c1 c2.
    destruct (Z.ltb_spec (Z.max (Z.min c1 c2) x_low) (Z.min (Z.max c1 c2) x_high)); [| reflexivity].
    do 3 step_word. reflexivity. }
  rewrite Row, !step_fits, !step_is_new by (try assumption; lia).
  rewrite IH; [reflexivity | lia | | |].
  - intros. replace (y + 1 + Z.of_nat n - 1) with (y + Z.of_nat (S n) - 1) by lia. auto.
  - lia.
  - subst other lower. destruct (Z.leb_spec (Y middle) (centre 128 y)).
    + right. destruct (Z.leb_spec (Y middle) (centre 128 (y + 1))); [reflexivity | lia].
    + destruct (Z.leb_spec (Y middle) (centre 128 (y + 1))); [left; lia | right; reflexivity].
Qed.

(** The whole of [Scanline::cover]: for all corners and windows of i32 its words hold every number,
    and it emits what the model emits. *)
Theorem scanline_fits a b c bounds : in_i32 a -> in_i32 b -> in_i32 c -> rect_in_i32 bounds ->
  scanline_words a b c bounds = Some (scanline 128 a b c bounds).
Proof.
  intros Ha Hb Hc HB. unfold scanline_words, scanline. rewrite sort_by_height_fits by assumption.
  pose proof (sort_keeps in_i32 a b c Ha Hb Hc) as I.
  destruct (sort_by_height_spec a b c) as (top & middle & bottom & E & Hs & _). rewrite E in *.
  destruct I as (It & Im & Ib). unfold rect_in_i32 in HB.
  destruct (first_centre_fits (Y top)) as [-> Rt]; [apply It |].
  destruct (first_centre_fits (Y middle)) as [-> Rm]; [apply Im |].
  destruct (first_centre_fits (Y bottom)) as [-> Rb]; [apply Ib |].
  set (split := first_centre 128 (Y middle)) in *.
  set (ya := Z.max _ _). set (yb := Z.min _ _).
  assert (R : forall j, Y top <= centre 128 j < Y bottom <->
                        first_centre 128 (Y top) <= j < first_centre 128 (Y bottom)).
  { intros j. pose proof (first_centre_le 128 (Y top) j ltac:(lia)).
    pose proof (first_centre_le 128 (Y bottom) j ltac:(lia)). lia. }
  destruct (Z.leb_spec yb ya); cbn [orb]; [reflexivity |].
  destruct (Z.leb_spec (x1 bounds) (x0 bounds)); [reflexivity |].
  pose proof (first_centre_le 128 (Y middle) ya ltac:(lia)) as F. fold split in F.
  pose proof (R ya). pose proof (R (yb - 1)).
  rewrite (EdgeWalk_new_fits top bottom) by (try assumption; lia).
  rewrite EdgeWalk_new_fits by (destruct (Z.leb_spec split ya); try assumption; lia).
  apply walk_fits; try assumption; try lia.
  - intros _. rewrite Z2Nat.id by lia. replace (ya + (yb - ya) - 1) with (yb - 1) by lia. lia.
  - destruct (Z.leb_spec split ya); [right | left]; lia.
  - right. destruct (Z.leb_spec split ya), (Z.leb_spec (Y middle) (centre 128 ya)); try lia; reflexivity.
Qed.
