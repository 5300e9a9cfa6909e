(** The edge-function engine in the words of its code (crates/core/src/raster/edge_function.rs), line by line:
    extents, the choice of the word, the box, the set-up of E before it is narrowed, and every step. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid EdgeFunction WordWidth Words ScanlineWords.
Import ListNotations.
Open Scope Z_scope.

(** a.max(b).max(c).abs_diff(a.min(b).min(c)) *)
Definition extent (u v w : Z) : option Z := fit u32 (Z.abs (max3 u v w - min3 u v w)).

Definition WordWidth_of (extent_x extent_y : Z) : option Z :=
  let* padded_x := fit u128 (extent_x + 256) in
  let* padded_y := fit u128 (extent_y + 256) in
  let* bound := fit u128 (padded_x * padded_y) in
  Some (if Z.shiftr bound 8 <? Z.shiftl 1 31 then 32
        else if bound <? Z.shiftl 1 63 then 64 else 128).

Definition centre_words (px : Z) : option Z :=
  let* n := fit i64 (px * 256) in fit i64 (n + 128).

(** Edge::at in the word T of the set-up. *)
Definition at_words (T : word) (a b : point) (x_sub y_sub : Z) : option Z :=
  let* dx := fit i64 (X b - X a) in
  let* dy := fit i64 (Y b - Y a) in
  let* down := fit i64 (y_sub - Y a) in
  let* right := fit i64 (x_sub - X a) in
  let* p := fit T (dx * down) in
  let* q := fit T (dy * right) in
  fit T (p - q).

(** Edge::enter: floor((E - bias) / S) in T, then narrowed to W. *)
Definition enter_words (T W : word) (a b : point) (x_px y_px : Z) : option Z :=
  let* x := centre_words x_px in
  let* y := centre_words y_px in
  let* e := at_words T a b x y in
  let* n := fit T (e - bias a b) in
  fit W (Z.shiftr n 8).

Definition right_words (W : word) (a b : point) : option Z :=
  let* dy := fit i64 (Y b - Y a) in let* n := fit i64 (- dy) in fit W n.

Definition down_words (W : word) (a b : point) : option Z :=
  let* dx := fit i64 (X b - X a) in fit W dx.

Definition each_words (f : point -> point -> option Z) (a b c : point) : option triple :=
  let* e0 := f b c in let* e1 := f c a in let* e2 := f a b in Some (e0, e1, e2).

Definition range_words (u v w : Z) : option (Z * Z) :=
  let* n := fit i64 (min3 u v w + 127) in
  let* first := fit i32 (Z.shiftr n 8) in
  let* m := fit i64 (max3 u v w + 128) in
  let* endd := fit i32 (Z.shiftr m 8) in
  Some (first, endd).

Definition pixel_box_words (a b c : point) (r : rect) : option rect :=
  let* (xa, xb) := range_words (X a) (X b) (X c) in
  let* (ya, yb) := range_words (Y a) (Y b) (Y c) in
  Some (Rect (Z.max xa (x0 r)) (Z.max ya (y0 r)) (Z.min xb (x1 r)) (Z.min yb (y1 r))).

Section Walk.
Variable W : word.

Definition add_words (e f : triple) : option triple :=
  let '(e0, e1, e2) := e in let '(f0, f1, f2) := f in
  let* g0 := fit W (e0 + f0) in let* g1 := fit W (e1 + f1) in let* g2 := fit W (e2 + f2) in
  Some (g0, g1, g2).

Fixpoint run_words (while_out : bool) (rights : triple) (n : nat) (x : Z) (e : triple) : option (nat * Z * triple) :=
  match n with
  | O => Some (O, x, e)
  | S m =>
      if Bool.eqb (out e) while_out then
        let* e := add_words e rights in
        let* x := fit i32 (x + 1) in
        run_words while_out rights m x e
      else Some (n, x, e)
  end.

Fixpoint walk_words (rights downs : triple) (width n : nat) (x y : Z) (row : triple) : option (list span) :=
  match n with
  | O => Some []
  | S m =>
      let* (n1, xa, e1) := run_words true rights width x row in
      let* (_, xb, _) := run_words false rights n1 xa e1 in
      let* y' := fit i32 (y + 1) in
      let* rest := match m with
        | O => Some []
        | S _ => let* row := add_words row downs in walk_words rights downs width m x y' row
        end in
      Some ((if xa <? xb then [(y, xa, xb)] else []) ++ rest)
  end.
End Walk.

Definition cover_in_words (T W : word) (a b c : point) (bounds : rect) : option (list span) :=
  let* r := pixel_box_words a b c bounds in
  if (x1 r <=? x0 r) || (y1 r <=? y0 r) then Some []
  else
    let* area := at_words T a b (X c) (Y c) in
    if area =? 0 then Some []
    else
      let b' := if 0 <? area then b else c in
      let c' := if 0 <? area then c else b in
      let* row := each_words (fun p q => enter_words T W p q (x0 r) (y0 r)) a b' c' in
      let* rights := each_words (right_words W) a b' c' in
      let* downs := each_words (down_words W) a b' c' in
      walk_words W rights downs (Z.to_nat (x1 r - x0 r)) (Z.to_nat (y1 r - y0 r)) (x0 r) (y0 r) row.

Definition edge_function_words (a b c : point) (bounds : rect) : option (list span) :=
  let* extent_x := extent (X a) (X b) (X c) in
  let* extent_y := extent (Y a) (Y b) (Y c) in
  let* width := WordWidth_of extent_x extent_y in
  if width =? 32 then cover_in_words i64 i32 a b c bounds
  else if width =? 64 then cover_in_words i64 i64 a b c bounds
  else cover_in_words i128 i128 a b c bounds.

(** ** It is the model, word for word *)

Lemma extent_fits u v w : - 2 ^ 31 <= u < 2 ^ 31 -> - 2 ^ 31 <= v < 2 ^ 31 -> - 2 ^ 31 <= w < 2 ^ 31 ->
  extent u v w = Some (max3 u v w - min3 u v w) /\ 0 <= max3 u v w - min3 u v w < 2 ^ 32.
Proof.
  intros. unfold extent.
  assert (R : 0 <= max3 u v w - min3 u v w < 2 ^ 32) by (unfold max3, min3; lia).
  rewrite Z.abs_eq by lia. split; [| exact R]. step_word. reflexivity.
Qed.

Lemma WordWidth_of_fits a b c : in_i32 a -> in_i32 b -> in_i32 c ->
  WordWidth_of (max3 (X a) (X b) (X c) - min3 (X a) (X b) (X c))
               (max3 (Y a) (Y b) (Y c) - min3 (Y a) (Y b) (Y c)) = Some (word_width a b c).
Proof.
  unfold in_i32. intros Ha Hb Hc.
  destruct (extent_fits (X a) (X b) (X c)) as [_ Rx]; try lia.
  destruct (extent_fits (Y a) (Y b) (Y c)) as [_ Ry]; try lia.
  unfold WordWidth_of, word_width. cbv zeta. revert Rx Ry.
  generalize (max3 (X a) (X b) (X c) - min3 (X a) (X b) (X c)),
    (max3 (Y a) (Y b) (Y c) - min3 (Y a) (Y b) (Y c)). intros u v Hu Hv.
  assert (0 <= (u + 256) * (v + 256) <= (2 ^ 32 + 256) * (2 ^ 32 + 256))
    by (split; [apply Z.mul_nonneg_nonneg | apply Z.mul_le_mono_nonneg]; lia).
  do 3 step_word. rewrite shift_8, !Z.shiftl_1_l. reflexivity.
Qed.

Lemma centre_words_fits px : - 2 ^ 31 <= px < 2 ^ 31 -> centre_words px = Some (centre 128 px).
Proof. intros. unfold centre_words. do 2 step_word. unfold centre. f_equal. lia. Qed.

(** The box of pixels fits i32, and its ends lie in the domain. *)
Lemma range_fits u v w : - 2 ^ 31 <= u < 2 ^ 31 -> - 2 ^ 31 <= v < 2 ^ 31 -> - 2 ^ 31 <= w < 2 ^ 31 ->
  range_words u v w = Some (first_centre 128 (min3 u v w), end_centre 128 (max3 u v w)).
Proof.
  intros Hu Hv Hw. unfold range_words.
  assert (M : - 2 ^ 31 <= min3 u v w < 2 ^ 31) by (unfold min3; lia).
  assert (N : - 2 ^ 31 <= max3 u v w < 2 ^ 31) by (unfold max3; lia).
  revert M N. generalize (min3 u v w), (max3 u v w). clear. intros m n Hm Hn.
  destruct (first_centre_fits m Hm) as [F _]. unfold first_centre_words in F.
  rewrite (fit_ok i64 (m + 127)) in * by fits_word. rewrite F. step_word.
  rewrite shift_8. unfold end_centre. change (2 * 128) with 256.
  assert (- 2 ^ 23 <= (n + 128) / 256 <= 2 ^ 23 + 1)
    by (split; [apply Z.div_le_lower_bound | apply Z.div_le_upper_bound]; lia).
  step_word. reflexivity.
Qed.

Theorem pixel_box_fits a b c r : in_i32 a -> in_i32 b -> in_i32 c ->
  pixel_box_words a b c r = Some (pixel_box 128 a b c r).
Proof.
  unfold in_i32. intros Ha Hb Hc. unfold pixel_box_words, pixel_box.
  rewrite !range_fits by lia. reflexivity.
Qed.

(** The set-up: E at a point of the box, both products and their difference, in a word that holds
    the area of the box. *)
Lemma at_fits T p q x y lx hx ly hy :
  low T <= - ((hx - lx) * (hy - ly)) - 1 -> (hx - lx) * (hy - ly) <= high T ->
  - 2 ^ 33 <= lx -> hx <= 2 ^ 33 -> - 2 ^ 33 <= ly -> hy <= 2 ^ 33 ->
  lx <= X p <= hx -> lx <= X q <= hx -> lx <= x <= hx ->
  ly <= Y p <= hy -> ly <= Y q <= hy -> ly <= y <= hy ->
  at_words T p q x y = Some (E p q x y) /\
  fit T (E p q x y - bias p q) = Some (E p q x y - bias p q).
Proof.
  intros L U. intros. pose proof (E_in_box p q x y lx hx ly hy ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lia) ltac:(lia) ltac:(lia)) as B.
  assert (0 <= bias p q <= 1) by (unfold bias; destruct (_ || _); lia).
  assert (P : forall u v, - (hx - lx) <= u <= hx - lx -> - (hy - ly) <= v <= hy - ly ->
    - ((hx - lx) * (hy - ly)) <= u * v <= (hx - lx) * (hy - ly)) by (clear; intros; nia).
  pose proof (P (X q - X p) (y - Y p) ltac:(lia) ltac:(lia)).
  pose proof (P (x - X p) (Y q - Y p) ltac:(lia) ltac:(lia)).
  split; [| apply fit_ok; lia].
  unfold at_words. do 4 step_word. rewrite !fit_ok; [reflexivity | unfold E in B; lia | lia | lia].
Qed.

Lemma fits_low_high W bits z : low W = - 2 ^ (bits - 1) -> high W = 2 ^ (bits - 1) - 1 ->
  fits bits z -> low W <= z <= high W.
Proof. unfold fits. intros. lia. Qed.

Section Covers.
Variables (bits : Z) (W : word) (a b c : point) (box : rect).
Hypotheses (Hbits : 0 < bits) (HL : low W = - 2 ^ (bits - 1)) (HH : high W = 2 ^ (bits - 1) - 1).
Hypothesis fits_all : forall p q px py, corner p a b c -> corner q a b c ->
  x0 box <= px <= x1 box -> y0 box <= py < y1 box ->
  fits bits (enter 128 p q px py) /\ fits bits (right p q) /\ fits bits (down p q).
Hypotheses (Bx : - 2 ^ 31 <= x0 box /\ x1 box < 2 ^ 31) (By : - 2 ^ 31 <= y0 box /\ y1 box < 2 ^ 31).

Let at_ (px py : Z) : triple := each bits (fun p q => enter 128 p q px py) a b c.
Let rights := each bits right a b c.
Let downs := each bits down a b c.
Let in_box px py := x0 box <= px <= x1 box /\ y0 box <= py < y1 box.

Lemma add_fits px py qx qy steps : in_box qx qy ->
  (let '(e0, e1, e2) := at_ px py in let '(f0, f1, f2) := steps in
   let '(g0, g1, g2) := (enter 128 b c qx qy, enter 128 c a qx qy, enter 128 a b qx qy) in
   e0 + f0 = g0 /\ e1 + f1 = g1 /\ e2 + f2 = g2) ->
  add_words W (at_ px py) steps = Some (at_ qx qy).
Proof.
  intros H S. destruct (at_exact 128 bits a b c box Hbits fits_all qx qy H) as (A & _).
  fold (at_ qx qy) in A. rewrite A. unfold add_words.
  destruct (at_ px py) as [[e0 e1] e2], steps as [[f0 f1] f2].
  destruct S as (-> & -> & ->).
  assert (F : forall p q, corner p a b c -> corner q a b c ->
    fit W (enter 128 p q qx qy) = Some (enter 128 p q qx qy)).
  { intros p q Hp Hq. apply fit_ok, (fits_low_high W bits); try assumption.
    apply (fits_all p q qx qy Hp Hq); apply H. }
  rewrite !F by (unfold corner; auto). reflexivity.
Qed.

Lemma add_rights px py : in_box px py -> in_box (px + 1) py ->
  add_words W (at_ px py) rights = Some (at_ (px + 1) py).
Proof.
  intros H0 H1. apply add_fits; [exact H1 |].
  destruct (at_exact 128 bits a b c box Hbits fits_all px py H0) as (A & R & _).
  fold (at_ px py) in A. fold rights in R. rewrite A, R.
  rewrite !enter_right by lia. auto.
Qed.

Lemma add_downs px py : in_box px py -> in_box px (py + 1) ->
  add_words W (at_ px py) downs = Some (at_ px (py + 1)).
Proof.
  intros H0 H1. apply add_fits; [exact H1 |].
  destruct (at_exact 128 bits a b c box Hbits fits_all px py H0) as (A & _ & R).
  fold (at_ px py) in A. fold downs in R. rewrite A, R.
  rewrite !enter_down by lia. auto.
Qed.

Lemma run_fits w py n : forall px, in_box px py -> in_box (px + Z.of_nat n) py ->
  run_words W w rights n px (at_ px py) = Some (run bits w rights n px (at_ px py)).
Proof.
  induction n as [| n IH]; intros px H0 H1; [reflexivity |]. cbn [run_words run].
  destruct (Bool.eqb (out (at_ px py)) w); [| reflexivity].
  assert (H2 : in_box (px + 1) py) by (unfold in_box in *; lia).
  rewrite add_rights by assumption. unfold in_box in *. step_word.
  replace (add bits (at_ px py) rights) with (at_ (px + 1) py)
    by (symmetry; apply (at_right 128 bits a b c box); auto; lia).
  apply IH; lia.
Qed.

Lemma walk_fits width px : px + Z.of_nat width = x1 box -> px = x0 box ->
  forall n y, y0 box <= y -> y + Z.of_nat n <= y1 box ->
  walk_words W rights downs width n px y (at_ px y) =
  Some (walk bits rights downs width n px y (at_ px y)).
Proof.
  intros Hw Hpx. induction n as [| n IH]; intros y Hy Hn; [reflexivity |]. cbn [walk_words walk].
  rewrite run_fits by (unfold in_box; lia).
  destruct (run_spec 128 bits a b c box ltac:(lia) Hbits fits_all true y width px) as (m & R & Hm & _);
    [lia | lia |].
  change (run bits true rights width px (at_ px y) =
    (m, px + Z.of_nat (width - m), at_ (px + Z.of_nat (width - m)) y)) in R.
  rewrite R. cbv beta iota. set (xa := px + Z.of_nat (width - m)) in *.
  rewrite run_fits by (unfold in_box; lia).
  match goal with |- context [run bits false ?r ?n ?x ?e] => destruct (run bits false r n x e) as [[k xb] e2] end.
  step_word. destruct n as [| n']; [reflexivity |].
  rewrite add_downs by (unfold in_box; lia). rewrite IH by lia.
  replace (add bits (at_ px y) downs) with (at_ px (y + 1))
    by (symmetry; apply (at_down 128 bits a b c box); auto; unfold in_box; lia).
  reflexivity.
Qed.
End Covers.

(** One width: T holds the padded area of the box, W holds what the model needs. *)
Lemma cover_in_fits T W bits a b c bounds :
  let u := max3 (X a) (X b) (X c) - min3 (X a) (X b) (X c) + 256 in
  let v := max3 (Y a) (Y b) (Y c) - min3 (Y a) (Y b) (Y c) + 256 in
  in_i32 a -> in_i32 b -> in_i32 c -> rect_in_i32 bounds ->
  word_is_wide_enough 128 bits a b c ->
  low T <= - (u * v) -> u * v <= high T ->
  low W = - 2 ^ (bits - 1) -> high W = 2 ^ (bits - 1) - 1 ->
  cover_in_words T W a b c bounds = Some (cover_in bits 128 a b c bounds).
Proof.
  intros u v Ha Hb Hc HB HW LT UT LW UW. unfold cover_in_words, cover_in.
  rewrite pixel_box_fits by assumption. set (r := pixel_box 128 a b c bounds).
  destruct (Z.leb_spec (x1 r) (x0 r)); cbn [orb]; [reflexivity |].
  destruct (Z.leb_spec (y1 r) (y0 r)); [reflexivity |].
  assert (InBox : forall x y, x0 r <= x < x1 r -> y0 r <= y < y1 r ->
    min3 (X a) (X b) (X c) <= centre 128 x <= max3 (X a) (X b) (X c) /\
    min3 (Y a) (Y b) (Y c) <= centre 128 y <= max3 (Y a) (Y b) (Y c)).
  { intros x y Hx Hy. rewrite <- !first_centre_le, <- !end_centre_lt by lia.
    cbn [r pixel_box x0 x1 y0 y1] in *. lia. }
  assert (RI : - 2 ^ 31 <= x0 r /\ x1 r < 2 ^ 31 /\ - 2 ^ 31 <= y0 r /\ y1 r < 2 ^ 31)
    by (unfold rect_in_i32 in HB; cbn [r pixel_box x0 x1 y0 y1]; lia).
  clearbody r. unfold in_i32 in Ha, Hb, Hc.
  assert (Mx : - 2 ^ 31 <= min3 (X a) (X b) (X c) /\ max3 (X a) (X b) (X c) < 2 ^ 31 /\
    min3 (X a) (X b) (X c) <= max3 (X a) (X b) (X c)) by (unfold min3, max3; lia).
  assert (My : - 2 ^ 31 <= min3 (Y a) (Y b) (Y c) /\ max3 (Y a) (Y b) (Y c) < 2 ^ 31 /\
    min3 (Y a) (Y b) (Y c) <= max3 (Y a) (Y b) (Y c)) by (unfold min3, max3; lia).
  assert (B : forall p, corner p a b c ->
    min3 (X a) (X b) (X c) <= X p <= max3 (X a) (X b) (X c) /\
    min3 (Y a) (Y b) (Y c) <= Y p <= max3 (Y a) (Y b) (Y c))
    by (intros p [-> | [-> | ->]]; unfold min3, max3; lia).
  assert (At : forall p q x y, corner p a b c -> corner q a b c ->
    min3 (X a) (X b) (X c) <= x <= max3 (X a) (X b) (X c) ->
    min3 (Y a) (Y b) (Y c) <= y <= max3 (Y a) (Y b) (Y c) ->
    at_words T p q x y = Some (E p q x y) /\
    fit T (E p q x y - bias p q) = Some (E p q x y - bias p q)).
  { intros p q x y Hp Hq Hx Hy. apply B in Hp, Hq.
    apply (at_fits T p q x y (min3 (X a) (X b) (X c)) (max3 (X a) (X b) (X c))
      (min3 (Y a) (Y b) (Y c)) (max3 (Y a) (Y b) (Y c))); try lia; subst u v; clear - LT UT Mx My; nia. }
  destruct (At a b (X c) (Y c)) as [-> _]; try (unfold corner; auto; fail); try apply B; try (unfold corner; auto; fail).
  fold (area2 a b c). destruct (area2 a b c =? 0); [reflexivity |].
  set (b' := if 0 <? area2 a b c then b else c). set (c' := if 0 <? area2 a b c then c else b).
  assert (C : forall p, corner p a b' c' -> corner p a b c)
    by (unfold corner, b', c'; intros p; destruct (0 <? area2 a b c); tauto).
  assert (Fits : forall p q px py, corner p a b' c' -> corner q a b' c' ->
    x0 r <= px <= x1 r -> y0 r <= py < y1 r ->
    fits bits (enter 128 p q px py) /\ fits bits (right p q) /\ fits bits (down p q)).
  { intros p q x y Hp%C Hq%C Hx Hy. apply (enter_fits 128 bits a b c); try assumption; try lia.
    - destruct (Z.eq_dec x (x1 r)) as [-> |]; [| destruct (InBox x y); lia].
      destruct (InBox (x1 r - 1) y); try lia. unfold centre in *; lia.
    - destruct (InBox (x0 r) y); lia. }
  assert (FW : forall z, fits bits z -> fit W z = Some z)
    by (intros; apply fit_ok, (fits_low_high W bits); assumption).
  destruct (InBox (x0 r) (y0 r)) as [Cx Cy]; try lia.
  assert (En : forall p q, corner p a b' c' -> corner q a b' c' ->
    enter_words T W p q (x0 r) (y0 r) = Some (enter 128 p q (x0 r) (y0 r))).
  { intros p q Hp Hq. unfold enter_words. rewrite !centre_words_fits by lia.
    destruct (At p q (centre 128 (x0 r)) (centre 128 (y0 r)) (C _ Hp) (C _ Hq) Cx Cy) as [-> ->].
    rewrite shift_8. apply FW. apply (Fits p q (x0 r) (y0 r)); auto; lia. }
  assert (St : forall p q, corner p a b' c' -> corner q a b' c' ->
    right_words W p q = Some (right p q) /\ down_words W p q = Some (down p q)).
  { intros p q Hp Hq. pose proof (B p (C _ Hp)). pose proof (B q (C _ Hq)).
    destruct (Fits p q (x0 r) (y0 r) Hp Hq) as (_ & R & D); try lia.
    unfold right_words, down_words, right, down in *. do 3 step_word. split; apply FW; assumption. }
  assert (Ca : corner a a b' c' /\ corner b' a b' c' /\ corner c' a b' c') by (unfold corner; auto).
  destruct Ca as (Ca & Cb & Cc). destruct HW as [Hbits HW].
  unfold each_words. rewrite !En by assumption.
  destruct (St b' c' Cb Cc) as [-> ->]. destruct (St c' a Cc Ca) as [-> ->].
  destruct (St a b' Ca Cb) as [-> ->].
  destruct (at_exact 128 bits a b' c' r Hbits Fits (x0 r) (y0 r)) as (A1 & A2 & A3); [lia |].
  rewrite <- A1, <- A2, <- A3. apply walk_fits with (box := r); auto; lia.
Qed.

(** The whole of [EdgeFunction::cover]: extents, width, box, set-up and steps stay in their words. *)
Theorem edge_function_fits a b c bounds : in_i32 a -> in_i32 b -> in_i32 c -> rect_in_i32 bounds ->
  edge_function_words a b c bounds = Some (edge_function a b c bounds).
Proof.
  intros Ha Hb Hc HB. unfold edge_function_words, edge_function.
  destruct (extent_fits (X a) (X b) (X c)) as [-> Rx]; [apply Ha | apply Hb | apply Hc |].
  destruct (extent_fits (Y a) (Y b) (Y c)) as [-> Ry]; [apply Ha | apply Hb | apply Hc |].
  rewrite WordWidth_of_fits by assumption.
  pose proof (word_width_is_enough a b c Ha Hb Hc) as HW.
  unfold word_width in *. cbv zeta in *.
  set (u := max3 (X a) (X b) (X c) - min3 (X a) (X b) (X c) + 256) in *.
  set (v := max3 (Y a) (Y b) (Y c) - min3 (Y a) (Y b) (Y c) + 256) in *.
  assert (0 <= u * v <= (2 ^ 32 + 256) * (2 ^ 32 + 256))
    by (split; [apply Z.mul_nonneg_nonneg | apply Z.mul_le_mono_nonneg]; unfold u, v; lia).
  pose proof (floor_lt (u * v) 256 (2 ^ 31) ltac:(lia)).
  destruct (Z.ltb_spec (u * v / 256) (2 ^ 31)); [| destruct (Z.ltb_spec (u * v) (2 ^ 63))]; cbn [Z.eqb Pos.eqb];
    apply cover_in_fits; try assumption; try reflexivity; fold u v; cbn [low high i64 i128]; lia.
Qed.
