(** The scanline engine (crates/core/src/raster/scanline.rs), loop by loop, and what it covers. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid.
Import ListNotations.
Open Scope Z_scope.

(** ** The exact DDA *)

(** Machines divide towards zero; the remainder is then brought into [0, d). *)
Definition floor_div (n d : Z) : Z * Z :=
  let q := Z.quot n d in let r := Z.rem n d in
  if r <? 0 then (q - 1, r + d) else (q, r).

Lemma floor_div_spec n d : 0 < d -> floor_div n d = (n / d, n mod d).
Proof.
  intros Hd. unfold floor_div.
  pose proof (Z.quot_rem n d ltac:(lia)) as QR.
  pose proof (Z.rem_bound_abs n d ltac:(lia)).
  destruct (Z.ltb_spec (Z.rem n d) 0); f_equal.
  - apply Z.div_unique with (r := Z.rem n d + d); lia.
  - apply Z.mod_unique with (q := Z.quot n d - 1); lia.
  - apply Z.div_unique with (r := Z.rem n d); lia.
  - apply Z.mod_unique with (q := Z.quot n d); lia.
Qed.

Record EdgeWalk := Walk { column : Z; remainder : Z; step_whole : Z; step_part : Z; dy : Z }.

(** Starts the edge from a down to b at a row of centres. *)
Definition EdgeWalk_new (h : Z) (a b : point) (y_px : Z) : EdgeWalk :=
  let dx := X b - X a in
  let dy := Y b - Y a in
  let down := centre h y_px - Y a in
  let base := X a / (2 * h) in
  let ax := X a mod (2 * h) - h in
  let n := ax * dy + down * dx in
  let numerator := (n + (2 * h - 1)) / (2 * h) in
  let '(minus_column, remainder) := floor_div (- numerator) dy in
  let '(whole, part) := floor_div dx dy in
  Walk (base - minus_column) remainder whole part dy.

(** Goes down one row: additions only. *)
Definition step (w : EdgeWalk) : EdgeWalk :=
  let r := remainder w - step_part w in
  if r <? 0
  then Walk (column w + step_whole w + 1) (r + dy w) (step_whole w) (step_part w) (dy w)
  else Walk (column w + step_whole w) r (step_whole w) (step_part w) (dy w).

Lemma EdgeWalk_new_spec h a b y : Y a < Y b -> EdgeWalk_new h a b y =
  let dx := X b - X a in
  let dy := Y b - Y a in
  let M := ((X a mod (2 * h) - h) * dy + (centre h y - Y a) * dx + (2 * h - 1)) / (2 * h) in
  Walk (X a / (2 * h) - (- M) / dy) ((- M) mod dy) (dx / dy) (dx mod dy) dy.
Proof. intros. unfold EdgeWalk_new. rewrite !floor_div_spec by lia. reflexivity. Qed.

(** One step of the walk is the walk started one row further down, in all its numbers. *)
Theorem step_is_new h a b y : 0 < h -> Y a < Y b ->
  step (EdgeWalk_new h a b y) = EdgeWalk_new h a b (y + 1).
Proof.
  intros Hh Hab. rewrite !EdgeWalk_new_spec by assumption. cbv zeta.
  set (dx := X b - X a). set (d := Y b - Y a). set (ax := X a mod (2 * h) - h).
  set (M := (ax * d + (centre h y - Y a) * dx + (2 * h - 1)) / (2 * h)).
  replace ((ax * d + (centre h (y + 1) - Y a) * dx + (2 * h - 1)) / (2 * h)) with (M + dx).
  2: { unfold M. rewrite <- floor_shift by lia. f_equal. unfold centre. ring. }
  assert (Hd : 0 < d) by (unfold d; lia).
  unfold step; cbn [remainder step_part column step_whole dy].
  pose proof (Z.div_mod (- M) d ltac:(lia)). pose proof (Z.mod_pos_bound (- M) d Hd).
  pose proof (Z.div_mod dx d ltac:(lia)). pose proof (Z.mod_pos_bound dx d Hd).
  destruct (Z.ltb_spec ((- M) mod d - dx mod d) 0); f_equal.
  - rewrite <- (Z.div_unique (- (M + dx)) d ((- M) / d - dx / d - 1) ((- M) mod d - dx mod d + d)); lia.
  - apply Z.mod_unique with (q := (- M) / d - dx / d - 1); lia.
  - rewrite <- (Z.div_unique (- (M + dx)) d ((- M) / d - dx / d) ((- M) mod d - dx mod d)); lia.
  - apply Z.mod_unique with (q := (- M) / d - dx / d); lia.
Qed.

Theorem remainder_range h a b y : Y a < Y b ->
  0 <= remainder (EdgeWalk_new h a b y) < dy (EdgeWalk_new h a b y).
Proof. intros. rewrite EdgeWalk_new_spec by assumption. apply Z.mod_pos_bound. cbn. lia. Qed.

(** Where the column is: the first centre that is not left of the edge. *)
Theorem column_left_of h a b px y : 0 < h -> Y a < Y b ->
  (column (EdgeWalk_new h a b y) <=? px) = left_of a b (centre h px) (centre h y).
Proof.
  intros Hh Hab. rewrite EdgeWalk_new_spec by assumption. unfold column, left_of. cbv zeta.
  apply eq_true_iff_eq. rewrite !Z.leb_le.
  set (n := _ + (_ - Y a) * _).
  pose proof (floor_le (- ((n + (2 * h - 1)) / (2 * h))) (Y b - Y a) (X a / (2 * h) - px)).
  pose proof (floor_lt (n + (2 * h - 1)) (2 * h) ((Y b - Y a) * (px - X a / (2 * h)) + 1)).
  pose proof (Z.div_mod (X a) (2 * h)). unfold n, centre in *. nia.
Qed.

(** The closed form: ceil(N / (S dy)) with N = (ax - S/2) dy + (yc - ay) dx. *)
Theorem column_closed_form h a b y : 0 < h -> Y a < Y b ->
  column (EdgeWalk_new h a b y) =
  - ((- ((X a - h) * (Y b - Y a) + (centre h y - Y a) * (X b - X a))) / (2 * h * (Y b - Y a))).
Proof.
  intros Hh Hab. set (N := _ + _).
  assert (forall i, column (EdgeWalk_new h a b y) <= i <-> - (- N / (2 * h * (Y b - Y a))) <= i).
  { intros i. rewrite <- Z.leb_le, column_left_of by assumption. unfold left_of. rewrite Z.leb_le.
    pose proof (floor_le (- N) (2 * h * (Y b - Y a)) (- i) ltac:(nia)). unfold N, centre in *. nia. }
  apply Z.le_antisymm; apply H; lia.
Qed.

(** ** The rows *)

(** From the top down; equal heights from left to right. *)
Definition before (a b : point) : bool :=
  (Y a <? Y b) || ((Y a =? Y b) && (X a <? X b)).

Definition sort_by_height (a b c : point) : point * point * point :=
  let sort a b := if before b a then (b, a) else (a, b) in
  let '(a, b) := sort a b in
  let '(b, c) := sort b c in
  let '(a, b) := sort a b in
  (a, b, c).

Section Rows.
Variables (h : Z) (middle bottom : point) (turn x_low x_high : Z).

Definition row_span (y_px : Z) (long short : EdgeWalk) : list span :=
  let x0 := Z.max (Z.min (column long) (column short)) x_low in
  let x1 := Z.min (Z.max (column long) (column short)) x_high in
  if x0 <? x1 then [(y_px, x0, x1)] else [].

Fixpoint walk (n : nat) (y_px : Z) (long short : EdgeWalk) : list span :=
  match n with
  | O => []
  | Datatypes.S n =>
      let short := if y_px =? turn then EdgeWalk_new h middle bottom y_px else short in
      row_span y_px long short ++ walk n (y_px + 1) (step long) (step short)
  end.
End Rows.

Definition scanline (h : Z) (a b c : point) (bounds : rect) : list span :=
  let '(top, middle, bottom) := sort_by_height a b c in
  let first := first_centre h (Y top) in
  let split := first_centre h (Y middle) in
  let endd := first_centre h (Y bottom) in
  let ya := Z.max first (y0 bounds) in
  let yb := Z.min endd (y1 bounds) in
  if (yb <=? ya) || (x1 bounds <=? x0 bounds) then []
  else
    let starts_low := split <=? ya in
    let turn := if starts_low then yb else split in
    let long := EdgeWalk_new h top bottom ya in
    let short :=
      EdgeWalk_new h (if starts_low then middle else top) (if starts_low then bottom else middle) ya in
    walk h middle bottom turn (x0 bounds) (x1 bounds) (Z.to_nat (yb - ya)) ya long short.

(** ** What it covers *)

Lemma sort_by_height_spec a b c : exists top middle bottom,
  sort_by_height a b c = (top, middle, bottom) /\ Y top <= Y middle <= Y bottom /\
  forall x y, inside top middle bottom x y = inside a b c x y.
Proof.
  unfold sort_by_height.
  assert (L : forall a b, before a b = true -> Y a <= Y b) by
    (unfold before; intros p q; decide_all; cbn; lia).
  assert (G : forall a b, before a b = false -> Y b <= Y a) by
    (unfold before; intros p q; decide_all; cbn; lia).
  repeat match goal with |- context [before ?p ?q] => destruct (before p q) eqn:? end;
    eexists _, _, _; (split; [reflexivity |]);
    repeat match goal with
    | H : before _ _ = true |- _ => apply L in H
    | H : before _ _ = false |- _ => apply G in H
    end; (split; [lia |]); intros x y; unfold inside;
    rewrite ?(crosses_sym b a), ?(crosses_sym c b), ?(crosses_sym a c);
    destruct (crosses a b x y), (crosses b c x y), (crosses c a x y); reflexivity.
Qed.

Lemma hits_row_span x_low x_high y long short px py :
  hits (row_span x_low x_high y long short) px py =
  Z.b2z ((y =? py) && (((x_low <=? px) && (px <? x_high)) &&
         xorb (column long <=? px) (column short <=? px))).
Proof.
  unfold row_span, hits.
  destruct (Z.ltb_spec (Z.max (Z.min (column long) (column short)) x_low)
                       (Z.min (Z.max (column long) (column short)) x_high)); cbn [in_span];
    decide_all; cbn [xorb andb Z.b2z]; lia.
Qed.

(** In the rows between top and bottom the long edge and one short edge cross the row. *)
Lemma inside_sorted top middle bottom x y :
  Y top <= Y middle <= Y bottom ->
  inside top middle bottom x y =
  ((Y top <=? y) && (y <? Y bottom)) &&
  xorb (left_of top bottom x y)
       (if Y middle <=? y then left_of middle bottom x y else left_of top middle x y).
Proof.
  intros. unfold inside, crosses, above.
  decide_all; try lia; cbn [andb]; try reflexivity;
    destruct (left_of top bottom x y), (left_of middle bottom x y), (left_of top middle x y);
    reflexivity.
Qed.

Lemma hits_walk h top middle bottom turn x_low x_high px py : 0 < h ->
  Y top <= Y middle <= Y bottom ->
  forall n y short,
  Y top <= centre h y -> (n <> O -> centre h (y + Z.of_nat n - 1) < Y bottom) ->
  (turn = first_centre h (Y middle) \/ first_centre h (Y middle) <= y /\ y + Z.of_nat n <= turn) ->
  (y = turn \/
   short = if Y middle <=? centre h y then EdgeWalk_new h middle bottom y else EdgeWalk_new h top middle y) ->
  hits (walk h middle bottom turn x_low x_high n y (EdgeWalk_new h top bottom y) short) px py =
  Z.b2z (((y <=? py) && (py <? y + Z.of_nat n)) && (((x_low <=? px) && (px <? x_high)) &&
         inside top middle bottom (centre h px) (centre h py))).
Proof.
  intros Hh Hs. induction n as [| n IH]; intros y short Hy Hn Ht Hshort.
  - cbn [walk hits]. decide_all; cbn [andb Z.b2z]; lia.
  - cbn [walk]. rewrite hits_app, hits_row_span.
    assert (Hc : centre h (y + 1) = centre h y + 2 * h) by (unfold centre; ring).
    assert (Hyb : centre h y < Y bottom) by (unfold centre in *; nia).
    pose proof (first_centre_le h (Y middle) y Hh) as F0.
    pose proof (first_centre_le h (Y middle) (y + 1) Hh) as F1.
    set (short' := if y =? turn then _ else short).
    assert (S : short' =
      if Y middle <=? centre h y then EdgeWalk_new h middle bottom y else EdgeWalk_new h top middle y).
    { subst short'. decide_all; destruct Hshort; try assumption; try lia; reflexivity. }
    rewrite S, step_is_new by lia.
    replace (step (if Y middle <=? centre h y then EdgeWalk_new h middle bottom y else EdgeWalk_new h top middle y))
      with (if Y middle <=? centre h y then EdgeWalk_new h middle bottom (y + 1) else EdgeWalk_new h top middle (y + 1))
      by (destruct (Z.leb_spec (Y middle) (centre h y)); rewrite step_is_new by lia; reflexivity).
    rewrite IH; try lia.
    2: { intros. replace (y + 1 + Z.of_nat n - 1) with (y + Z.of_nat (Datatypes.S n) - 1) by lia. auto. }
    2: { decide_all; try lia; auto. }
    set (cols := (x_low <=? px) && (px <? x_high)).
    replace (y + Z.of_nat (Datatypes.S n)) with (y + 1 + Z.of_nat n) by lia.
    rewrite <- row_by_row by lia. f_equal. f_equal.
    destruct (Z.eqb_spec y py) as [<- |]; [| reflexivity]. cbn [andb]. f_equal.
    rewrite inside_sorted by assumption.
    replace (Y top <=? centre h y) with true by (symmetry; apply Z.leb_le; lia).
    replace (centre h y <? Y bottom) with true by (symmetry; apply Z.ltb_lt; lia).
    cbn [andb]. rewrite column_left_of by lia. f_equal.
    destruct (Z.leb_spec (Y middle) (centre h y)); rewrite column_left_of by lia; reflexivity.
Qed.

(** The scanline engine hits every pixel of the window whose centre is inside, once. *)
Theorem scanline_hits h a b c bounds px py : 0 < h ->
  hits (scanline h a b c bounds) px py =
  Z.b2z (in_rect bounds px py && inside a b c (centre h px) (centre h py)).
Proof.
  intros Hh. destruct (sort_by_height_spec a b c) as (top & middle & bottom & E & Hs & <-).
  unfold scanline, in_rect. rewrite E.
  set (split := first_centre h (Y middle)).
  set (ya := Z.max _ _). set (yb := Z.min _ _).
  assert (R : forall j, Y top <= centre h j < Y bottom <->
                        first_centre h (Y top) <= j < first_centre h (Y bottom)).
  { intros j. pose proof (first_centre_le h (Y top) j Hh).
    pose proof (first_centre_le h (Y bottom) j Hh). lia. }
  destruct (Z.leb_spec yb ya); cbn [orb];
    [| destruct (Z.leb_spec (x1 bounds) (x0 bounds))].
  1, 2: cbn [hits]; rewrite inside_sorted by assumption; specialize (R py);
    match goal with |- 0 = Z.b2z ?b => destruct b eqn:C; [exfalso | reflexivity] end;
    rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in C; lia.
  pose proof (first_centre_le h (Y middle) ya Hh) as F. fold split in F.
  pose proof (R ya). pose proof (R (yb - 1)).
  rewrite (hits_walk h top middle bottom); try assumption; try lia.
  - rewrite Z2Nat.id by lia. rewrite inside_sorted by assumption. specialize (R py).
    f_equal. apply eq_true_iff_eq. rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt.
    subst ya yb. clear - R. intuition lia.
  - intros _. rewrite Z2Nat.id by lia. replace (ya + (yb - ya) - 1) with (yb - 1) by lia. lia.
  - decide_all; [right | left]; lia.
  - right. decide_all; try lia; reflexivity.
Qed.
