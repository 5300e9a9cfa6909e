(** The line drawers in the words of their code (crates/core/src/line/dda.rs, crates/core/src/line/bresenham.rs), line by line:
    no operation overflows and no cast changes a number, for all ends and windows in i32. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid WordWidth Words ScanlineWords Lines.
Import ListNotations.
Open Scope Z_scope.

(** Both drawers: the half-open range of coordinates as distances from [start]. *)
Definition offsets_words (low high start sign : Z) : option (Z * Z) :=
  if 0 <? sign then
    let* first := fit i64 (low - start) in let* endd := fit i64 (high - start) in Some (first, endd)
  else
    let* n := fit i64 (start - high) in let* first := fit i64 (n + 1) in
    let* m := fit i64 (start - low) in let* endd := fit i64 (m + 1) in Some (first, endd).

(** ** The DDA *)

Definition Slope_new_words (a b : point) : option slope :=
  let* dx := fit i64 (X b - X a) in
  let* dy := fit i64 (Y b - Y a) in
  let* abs_dx := fit i64 (Z.abs dx) in
  let* abs_dy := fit i64 (Z.abs dy) in
  let x_is_major := abs_dy <=? abs_dx in
  let major := if x_is_major then dx else dy in
  let minor := if x_is_major then dy else dx in
  let* length := fit i64 (Z.abs major) in
  let* rise := fit i64 (Z.abs minor) in
  Some (Slope a x_is_major (if major <? 0 then -1 else 1) (if minor <? 0 then -1 else 1) length rise).

Definition height_at_words (s : slope) (step : Z) : option height :=
  if length s =? 0 then Some (Height 0 0)
  else
    let* step := fit u64 step in
    let* rise := fit u64 (rise s) in
    let* numerator := fit u64 (step * rise) in
    let* length := fit u64 (length s) in
    let* whole := fit i64 (numerator / length) in
    let* part := fit i64 (numerator mod length) in
    Some (Height whole part).

Definition next_words (s : slope) (t : height) : option height :=
  let* p := fit i64 (part t + rise s) in
  if (length s <=? p) && (0 <? length s) then
    let* w := fit i64 (whole t + 1) in
    let* q := fit i64 (p - length s) in
    Some (Height w q)
  else Some (Height (whole t) p).

Definition round_words (s : slope) (t : height) : option Z :=
  let* twice := fit i64 (2 * part t) in
  let up := if 0 <? forward s then length s <=? twice else length s <? twice in
  fit i64 (whole t + (if up && (0 <? length s) then 1 else 0)).

Definition pixel_words (s : slope) (step height : Z) : option point :=
  let* major := fit i64 (forward s * step) in
  let* minor := fit i64 (upward s * height) in
  let dx := if x_is_major s then major else minor in
  let dy := if x_is_major s then minor else major in
  let* x := fit i64 (X (origin s) + dx) in
  let* y := fit i64 (Y (origin s) + dy) in
  let* x := fit i32 x in
  let* y := fit i32 y in
  Some (Pt x y).

Fixpoint bisect_words (f : Z -> option Z) (wanted : Z) (fuel : nat) (low high : Z) : option Z :=
  match fuel with
  | O => Some low
  | S fuel =>
      if low <? high then
        let* width := fit i64 (high - low) in
        let* middle := fit i64 (low + Z.quot width 2) in
        let* there := f middle in
        if there <? wanted then
          let* low := fit i64 (middle + 1) in bisect_words f wanted fuel low high
        else bisect_words f wanted fuel low middle
      else Some low
  end.

Definition first_at_height_words (s : slope) (first endd wanted : Z) : option Z :=
  bisect_words (fun i => let* t := height_at_words s i in round_words s t) wanted
    (Z.to_nat (Z.log2 (endd - first) + 1)) first endd.

Definition steps_within_words (s : slope) (r : rect) : option (Z * Z) :=
  let ox := X (origin s) in
  let oy := Y (origin s) in
  let* (major_first, major_end) :=
    if x_is_major s then offsets_words (x0 r) (x1 r) ox (forward s)
    else offsets_words (y0 r) (y1 r) oy (forward s) in
  let* (minor_first, minor_end) :=
    if x_is_major s then offsets_words (y0 r) (y1 r) oy (upward s)
    else offsets_words (x0 r) (x1 r) ox (upward s) in
  let* past := fit i64 (length s + 1) in
  let first := Z.max major_first 0 in
  let endd := Z.min major_end past in
  if (endd <=? first) || (minor_end <=? minor_first) then Some (0, 0)
  else
    let* from := first_at_height_words s first endd minor_first in
    let* to := first_at_height_words s first endd minor_end in
    Some (from, to).

Fixpoint dda_walk_words (s : slope) (n : nat) (step : Z) (t : height) : option (list point) :=
  match n with
  | O => Some []
  | S n =>
      let* h := round_words s t in
      let* p := pixel_words s step h in
      let* t := next_words s t in
      let* rest := dda_walk_words s n (step + 1) t in
      Some (p :: rest)
  end.

Definition dda_words (a b : point) (r : rect) : option (list point) :=
  let* s := Slope_new_words a b in
  let* (first, endd) := steps_within_words s r in
  if endd <=? first then Some []
  else
    let* t := height_at_words s first in
    dda_walk_words s (Z.to_nat (endd - first)) first t.

(** ** Bresenham *)

Definition first_step_at_words (du dv tie wanted : Z) : option Z :=
  if wanted <=? 0 then Some 0
  else if (dv =? 0) || (dv <? wanted) then Some (high i64)
  else
    let* n := fit i128 (2 * du) in
    let* n := fit i128 (n * wanted) in
    let* n := fit i128 (n - du) in
    let* numerator := fit i128 (n + tie) in
    let* twice := fit i128 (2 * dv) in
    let* n := fit i128 (numerator + twice) in
    let* n := fit i128 (n - 1) in
    fit i64 (Z.quot n twice).

Definition enter_words (du dv tie step : Z) : option (Z * Z) :=
  if du =? 0 then Some (0, -1)
  else
    let* n := fit i128 (2 * step) in
    let* twice := fit i128 (n * dv) in
    let* n := fit i128 (twice + du) in
    let* n := fit i128 (n - tie) in
    let* width := fit i128 (2 * du) in
    let risen := Z.quot n width in
    let* twice_dv := fit i128 (2 * dv) in
    let* n := fit i128 (twice + twice_dv) in
    let* n := fit i128 (n - du) in
    let* n := fit i128 (n - tie) in
    let* m := fit i128 (width * risen) in
    let* n := fit i128 (n - m) in
    let* risen := fit i64 risen in
    let* decision := fit i64 n in
    Some (risen, decision).

Section Bresenham.
Variables (steep : bool) (u v u_sign v_sign du dv : Z).

Fixpoint bresenham_walk_words (n : nat) (step risen decision : Z) : option (list point) :=
  match n with
  | O => Some []
  | S n =>
      let* major := fit i64 (u_sign * step) in
      let* major := fit i64 (u + major) in
      let* minor := fit i64 (v_sign * risen) in
      let* minor := fit i64 (v + minor) in
      let* x := fit i32 (if steep then minor else major) in
      let* y := fit i32 (if steep then major else minor) in
      let* twice_du := fit i64 (2 * du) in
      let* risen := if 0 <=? decision then fit i64 (risen + 1) else Some risen in
      let* decision := if 0 <=? decision then fit i64 (decision - twice_du) else Some decision in
      let* twice_dv := fit i64 (2 * dv) in
      let* decision := fit i64 (decision + twice_dv) in
      let* rest := bresenham_walk_words n (step + 1) risen decision in
      Some (Pt x y :: rest)
  end.
End Bresenham.

Definition bresenham_words (a b : point) (r : rect) : option (list point) :=
  let* dx := fit i64 (X b - X a) in
  let* dy := fit i64 (Y b - Y a) in
  let* abs_dx := fit i64 (Z.abs dx) in
  let* abs_dy := fit i64 (Z.abs dy) in
  let steep := abs_dx <? abs_dy in
  let u0 := if steep then Y a else X a in
  let u1 := if steep then Y b else X b in
  let v0 := if steep then X a else Y a in
  let v1 := if steep then X b else Y b in
  let* n := fit i64 (u1 - u0) in
  let* du := fit i64 (Z.abs n) in
  let* n := fit i64 (v1 - v0) in
  let* dv := fit i64 (Z.abs n) in
  let backwards := u1 <? u0 in
  let u_sign := if backwards then -1 else 1 in
  let v_sign := if v1 <? v0 then -1 else 1 in
  let tie := if backwards then 1 else 0 in
  let* (u_first, u_end) :=
    if steep then offsets_words (y0 r) (y1 r) u0 u_sign else offsets_words (x0 r) (x1 r) u0 u_sign in
  let* (v_first, v_end) :=
    if steep then offsets_words (x0 r) (x1 r) v0 v_sign else offsets_words (y0 r) (y1 r) v0 v_sign in
  let* first := first_step_at_words du dv tie v_first in
  let* last := first_step_at_words du dv tie v_end in
  let* past := fit i64 (du + 1) in
  let first := Z.max (Z.max first u_first) 0 in
  let endd := Z.min (Z.min last u_end) past in
  if (endd <=? first) || (v_end <=? v_first) then Some []
  else
    let* (risen, decision) := enter_words du dv tie first in
    bresenham_walk_words steep u0 v0 u_sign v_sign du dv (Z.to_nat (endd - first)) first risen decision.

(** ** They are the models, word for word *)

Lemma offsets_fit low high start sign : - 2 ^ 31 <= low < 2 ^ 31 -> - 2 ^ 31 <= high < 2 ^ 31 ->
  - 2 ^ 31 <= start < 2 ^ 31 -> offsets_words low high start sign = Some (offsets low high start sign).
Proof.
  intros. unfold offsets_words, offsets. destruct (0 <? sign).
  - do 2 step_word. reflexivity.
  - do 4 step_word. reflexivity.
Qed.

Lemma Slope_new_fits a b : in_i32 a -> in_i32 b -> Slope_new_words a b = Some (slope_of a b).
Proof.
  unfold in_i32. intros Ha Hb. unfold Slope_new_words, slope_of. do 4 step_word.
  destruct (Z.abs (Y b - Y a) <=? Z.abs (X b - X a)); do 2 step_word; reflexivity.
Qed.

Section Dda.
Variables (s : slope) (r : rect).
Hypotheses (Hs : 0 <= rise s <= length s) (Hl : length s < 2 ^ 32).
Hypotheses (Hf : forward s = 1 \/ forward s = -1) (Hu : upward s = 1 \/ upward s = -1).
Hypothesis Ho : in_i32 (origin s).
Hypothesis Hr : rect_in_i32 r.
Hypothesis between : forall i h, 0 <= i <= length s -> 0 <= h <= rise s -> in_i32 (pixel s i h).

Lemma height_at_range i : 0 <= i <= length s -> 0 <= part (height_at s i) /\
  part (height_at s i) <= length s /\ 0 <= whole (height_at s i) <= length s.
Proof.
  intros Hi. unfold height_at. destruct (Z.eqb_spec (length s) 0); cbn [part whole]; [lia |].
  pose proof (Z.mod_pos_bound (i * rise s) (length s) ltac:(lia)).
  assert (0 <= i * rise s <= length s * length s) by (clear - Hi Hs; nia).
  repeat split; try lia; [apply Z.div_pos; lia | apply Z.div_le_upper_bound; lia].
Qed.

Lemma height_at_fits i : 0 <= i <= length s -> height_at_words s i = Some (height_at s i).
Proof.
  intros Hi. pose proof (height_at_range i Hi) as R. revert R. unfold height_at_words, height_at.
  destruct (Z.eqb_spec (length s) 0); [reflexivity |]. cbn [part whole]. intros R.
  assert (0 <= i * rise s <= (2 ^ 32 - 1) * (2 ^ 32 - 1)) by (split; [apply Z.mul_nonneg_nonneg | apply Z.mul_le_mono_nonneg]; lia).
  do 4 step_word. do 2 step_word. reflexivity.
Qed.

Lemma next_fits i : 0 <= i <= length s -> next_words s (height_at s i) = Some (next s (height_at s i)).
Proof.
  intros Hi. pose proof (height_at_range i Hi). unfold next_words, next. step_word.
  destruct (_ && _); [| reflexivity]. do 2 step_word. reflexivity.
Qed.

Lemma round_fits i : 0 <= i <= length s -> round_words s (height_at s i) = Some (round s (height_at s i)).
Proof.
  intros Hi. pose proof (height_at_range i Hi). unfold round_words, round. step_word.
  apply fit_ok. destruct (_ && (0 <? length s)); fits_word.
Qed.

Lemma pixel_fits i h : 0 <= i <= length s -> 0 <= h <= rise s ->
  pixel_words s i h = Some (pixel s i h).
Proof.
  intros Hi Hh. pose proof (between i h Hi Hh) as B. unfold in_i32, pixel in *. unfold pixel_words.
  assert (- 2 ^ 32 < forward s * i < 2 ^ 32) by (destruct Hf as [-> | ->]; lia).
  assert (- 2 ^ 32 < upward s * h < 2 ^ 32) by (destruct Hu as [-> | ->]; lia).
  do 2 step_word. destruct (x_is_major s); cbn [X Y] in *; do 4 step_word; reflexivity.
Qed.

Lemma bisect_fits f g wanted : (forall i, 0 <= i <= length s -> f i = Some (g i)) ->
  forall fuel low high, 0 <= low -> high <= length s + 1 ->
  bisect_words f wanted fuel low high = Some (bisect g wanted fuel low high).
Proof.
  intros Hfg. induction fuel as [| fuel IH]; intros low high HL HH; [reflexivity |].
  cbn [bisect_words bisect]. destruct (Z.ltb_spec low high); [| reflexivity].
  step_word. rewrite Z.quot_div_nonneg by lia.
  pose proof (Z.div_mod (high - low) 2 ltac:(lia)). pose proof (Z.mod_pos_bound (high - low) 2 ltac:(lia)).
  set (middle := low + (high - low) / 2) in *. step_word. rewrite Hfg by lia.
  destruct (g middle <? wanted); [step_word |]; apply IH; lia.
Qed.

Lemma first_at_height_fits first endd wanted : 0 <= first -> endd <= length s + 1 ->
  first_at_height_words s first endd wanted = Some (first_at_height s first endd wanted).
Proof.
  intros. apply (bisect_fits _ (fun i => round s (height_at s i))); try assumption.
  intros i Hi. rewrite height_at_fits by exact Hi. apply round_fits. exact Hi.
Qed.

Lemma steps_within_fits : steps_within_words s r = Some (steps_within s r) /\
  0 <= fst (steps_within s r) /\ snd (steps_within s r) <= length s + 1.
Proof.
  unfold rect_in_i32, in_i32 in *. unfold steps_within_words, steps_within.
  destruct (x_is_major s); rewrite !offsets_fit by lia.
  all: do 2 match goal with |- context [offsets ?l ?h ?o ?g] => destruct (offsets l h o g) end.
  all: step_word; cbn [fst snd].
  all: match goal with |- context [Z.leb ?e ?f || Z.leb ?n ?m] =>
         destruct (Z.leb_spec e f); cbn [orb fst snd]; [split; [reflexivity | lia] |];
         destruct (Z.leb_spec n m); cbn [fst snd]; [split; [reflexivity | lia] |];
         rewrite !first_at_height_fits by lia; (split; [reflexivity |]);
         destruct (first_at_height_spec s f e m) as [F _]; try assumption;
         destruct (first_at_height_spec s f e n) as [G _]; try assumption; lia end.
Qed.

Lemma dda_walk_fits n : forall i, 0 <= i -> i + Z.of_nat n <= length s + 1 ->
  dda_walk_words s n i (height_at s i) = Some (dda_walk s n i (height_at s i)).
Proof.
  induction n as [| n IH]; intros i Hi Hn; [reflexivity |]. cbn [dda_walk_words dda_walk].
  rewrite round_fits, pixel_fits, next_fits, next_is_height, IH; try lia; [reflexivity |].
  rewrite round_is_rise by assumption. apply rise_at_range; try lia. unfold tie. destruct (_ <? 0); lia.
Qed.
End Dda.

(** The whole of the DDA's drawing. *)
Theorem dda_fits a b r : in_i32 a -> in_i32 b -> rect_in_i32 r -> dda_words a b r = Some (dda a b r).
Proof.
  intros Ha Hb Hr. unfold dda_words, dda. rewrite Slope_new_fits by assumption.
  destruct (slope_of_ok a b) as (Hs & Hf & Hu).
  assert (Hl : length (slope_of a b) < 2 ^ 32)
    by (unfold in_i32, slope_of in *; cbn [length]; destruct (_ <=? _); lia).
  assert (Ho : in_i32 (origin (slope_of a b))) by exact Ha.
  assert (B : forall i h, 0 <= i <= length (slope_of a b) -> 0 <= h <= rise (slope_of a b) ->
    in_i32 (pixel (slope_of a b) i h)).
  { unfold in_i32, pixel, slope_of in *; cbn [x_is_major origin forward upward length rise]. intros i h.
    destruct (Z.abs (Y b - Y a) <=? Z.abs (X b - X a)); cbn [X Y];
      destruct (Z.ltb_spec (X b - X a) 0), (Z.ltb_spec (Y b - Y a) 0); lia. }
  set (s := slope_of a b) in *. clearbody s.
  destruct (steps_within_fits s r Hs Hl Hf Ho Hr) as (-> & W0 & W1).
  destruct (steps_within s r) as [first endd]; cbn [fst snd] in *.
  destruct (Z.leb_spec endd first).
  - replace (Z.to_nat (endd - first)) with O by lia. reflexivity.
  - rewrite height_at_fits, dda_walk_fits by (try assumption; lia). reflexivity.
Qed.

Lemma first_step_at_fits du dv t wanted : 0 <= dv <= du -> du < 2 ^ 32 -> 0 <= t <= 1 ->
  first_step_at_words du dv t wanted = Some (first_step_at du dv t wanted).
Proof.
  intros Hdv Hdu Ht. unfold first_step_at_words, first_step_at.
  destruct (Z.leb_spec wanted 0); [reflexivity |].
  destruct (Z.eqb_spec dv 0); [reflexivity |].
  destruct (Z.ltb_spec dv wanted); [reflexivity |]. cbn [orb].
  assert (0 <= 2 * du * wanted <= 2 * 2 ^ 32 * 2 ^ 32)
    by (split; [apply Z.mul_nonneg_nonneg | apply Z.mul_le_mono_nonneg]; lia).
  assert (du * 1 <= du * wanted) by (apply Z.mul_le_mono_nonneg_l; lia).
  do 7 step_word.
  rewrite Z.quot_div_nonneg by lia. apply fit_ok. cbn [low high i64].
  split; [pose proof (Z.div_pos (2 * du * wanted - du + t + 2 * dv - 1) (2 * dv)); lia |].
  assert (2 * du * wanted <= 2 * du * dv) by (apply Z.mul_le_mono_nonneg_l; lia).
  transitivity (du + 1); [apply Z.div_le_upper_bound; lia | lia].
Qed.

Lemma enter_fits du dv t i : 0 <= dv <= du -> du < 2 ^ 32 -> 0 <= t <= 1 -> 0 <= i <= du ->
  enter_words du dv t i = Some (enter du dv t i).
Proof.
  intros Hdv Hdu Ht Hi. unfold enter_words. destruct (Z.eqb_spec du 0) as [-> |]; [reflexivity |].
  rewrite enter_spec by lia. pose proof (rise_at_range du dv t i Hdv Ht Hi) as R.
  pose proof (rise_at_le du dv t i (rise_at du dv t i) ltac:(lia)).
  pose proof (rise_at_le du dv t i (rise_at du dv t i + 1) ltac:(lia)).
  assert (0 <= 2 * i * dv <= 2 * 2 ^ 32 * 2 ^ 32)
    by (split; [apply Z.mul_nonneg_nonneg | apply Z.mul_le_mono_nonneg]; lia).
  do 5 step_word.
  assert (Q : Z.quot (2 * i * dv + du - t) (2 * du) = rise_at du dv t i).
  { rewrite Z.quot_div_nonneg by lia. unfold rise_at. destruct (Z.eqb_spec du 0); [lia | reflexivity]. }
  rewrite Q. set (k := rise_at du dv t i) in *. clearbody k.
  assert (0 <= 2 * du * k <= 2 * 2 ^ 32 * 2 ^ 32)
    by (split; [apply Z.mul_nonneg_nonneg | apply Z.mul_le_mono_nonneg]; lia).
  do 6 step_word. do 2 step_word. do 2 f_equal. ring.
Qed.

Lemma bresenham_walk_fits steep u v us vs du dv t : 0 <= dv <= du -> du < 2 ^ 32 -> 0 <= t <= 1 ->
  us = 1 \/ us = -1 -> vs = 1 \/ vs = -1 -> - 2 ^ 31 <= u < 2 ^ 31 -> - 2 ^ 31 <= v < 2 ^ 31 ->
  - 2 ^ 31 <= u + us * du < 2 ^ 31 -> - 2 ^ 31 <= v + vs * dv < 2 ^ 31 ->
  forall n i, 0 <= i -> i + Z.of_nat n <= du + 1 ->
  (let '(risen, decision) := enter du dv t i in
   bresenham_walk_words steep u v us vs du dv n i risen decision =
   Some (bresenham_walk steep u v us vs du dv n i risen decision)).
Proof.
  intros Hdv Hdu Ht Hus Hvs Hu Hv Hu' Hv'.
  assert (Coordinates : forall i h, 0 <= i <= du -> 0 <= h <= dv ->
    - 2 ^ 32 < us * i < 2 ^ 32 /\ - 2 ^ 32 < vs * h < 2 ^ 32 /\
    - 2 ^ 31 <= u + us * i < 2 ^ 31 /\ - 2 ^ 31 <= v + vs * h < 2 ^ 31)
    by (destruct Hus as [-> | ->], Hvs as [-> | ->]; lia).
  destruct (Z.eq_dec du 0) as [D0 | D0].
  - intros [| [| n]] i Hi Hn; unfold enter; rewrite D0; cbn [Z.eqb]; try reflexivity; [| lia].
    destruct (Coordinates i 0) as (? & ? & ? & ?); try lia.
    cbn [bresenham_walk_words bresenham_walk]. do 4 step_word.
    destruct steep; cbn [Z.leb Z.compare]; do 5 step_word; reflexivity.
  - induction n as [| n IH]; intros i Hi Hn; rewrite enter_spec by lia; [reflexivity |].
    specialize (IH (i + 1)). rewrite enter_spec in IH by lia.
    pose proof (rise_at_range du dv t i Hdv Ht ltac:(lia)) as R.
    set (k := rise_at du dv t i) in *.
    pose proof (rise_at_le du dv t i k ltac:(lia)). pose proof (rise_at_le du dv t i (k + 1) ltac:(lia)).
    assert (N : rise_at du dv t (i + 1) = if 0 <=? 2 * (i + 1) * dv - du - t - 2 * du * k then k + 1 else k)
      by (apply rise_at_unique; [lia |]; decide_all; lia).
    rewrite N in IH. set (p := 2 * (i + 1) * dv - du - t - 2 * du * k) in *.
    assert (P : - 2 ^ 35 <= p <= 2 ^ 35) by (unfold p; lia).
    destruct (Coordinates i k) as (? & ? & ? & ?); try lia.
    cbn [bresenham_walk_words bresenham_walk]. do 4 step_word.
    assert (Next : 2 * (i + 1 + 1) * dv - du - t - 2 * du * (if 0 <=? p then k + 1 else k) =
      (if 0 <=? p then p - 2 * du else p) + 2 * dv)
      by (unfold p; decide_all; ring).
    rewrite Next in IH. clear Next N. clearbody p k.
    destruct (0 <=? p), steep; repeat step_word;
      rewrite IH by lia; reflexivity.
Qed.

(** The whole of Bresenham's drawing. *)
Theorem bresenham_fits a b r : in_i32 a -> in_i32 b -> rect_in_i32 r ->
  bresenham_words a b r = Some (bresenham a b r).
Proof.
  unfold in_i32, rect_in_i32. intros Ha Hb Hr. unfold bresenham_words, bresenham. do 4 step_word.
  set (steep := Z.abs (X b - X a) <? Z.abs (Y b - Y a)).
  set (u0 := if steep then Y a else X a). set (u1 := if steep then Y b else X b).
  set (v0 := if steep then X a else Y a). set (v1 := if steep then X b else Y b).
  assert (Hd : 0 <= Z.abs (v1 - v0) <= Z.abs (u1 - u0))
    by (subst u0 u1 v0 v1; unfold steep; destruct (Z.ltb_spec (Z.abs (X b - X a)) (Z.abs (Y b - Y a))); lia).
  assert (U : - 2 ^ 31 <= u0 < 2 ^ 31 /\ - 2 ^ 31 <= u1 < 2 ^ 31 /\ - 2 ^ 31 <= v0 < 2 ^ 31 /\ - 2 ^ 31 <= v1 < 2 ^ 31)
    by (subst u0 u1 v0 v1; destruct steep; lia).
  clearbody u0 u1 v0 v1 steep. do 4 step_word.
  set (t := if u1 <? u0 then 1 else 0).
  set (us := if u1 <? u0 then -1 else 1). set (vs := if v1 <? v0 then -1 else 1).
  assert (Ht : 0 <= t <= 1) by (subst t; destruct (u1 <? u0); lia).
  assert (Hus : (us = 1 \/ us = -1) /\ u0 + us * Z.abs (u1 - u0) = u1)
    by (subst us; destruct (Z.ltb_spec u1 u0); lia).
  assert (Hvs : (vs = 1 \/ vs = -1) /\ v0 + vs * Z.abs (v1 - v0) = v1)
    by (subst vs; destruct (Z.ltb_spec v1 v0); lia).
  assert (Hdu : Z.abs (u1 - u0) < 2 ^ 32) by lia.
  destruct Hus as [Hus Eu], Hvs as [Hvs Ev].
  set (du := Z.abs (u1 - u0)) in *. set (dv := Z.abs (v1 - v0)) in *. clearbody du dv t us vs.
  destruct steep; rewrite !offsets_fit by lia.
  all: do 2 match goal with |- context [offsets ?l ?h ?o ?g] => destruct (offsets l h o g) end.
  all: rewrite !first_step_at_fits by assumption; step_word; cbn [fst snd].
  all: set (first := Z.max (Z.max _ _) 0); set (endd := Z.min (Z.min _ _) (du + 1)).
  all: assert (F : 0 <= first) by (subst first; lia); assert (G : endd <= du + 1) by (subst endd; lia).
  all: clearbody first endd; destruct (Z.leb_spec endd first); cbn [orb]; [reflexivity |].
  all: match goal with |- context [Z.leb ?n ?m] => destruct (Z.leb_spec n m); [reflexivity |] end.
  all: rewrite enter_fits by lia.
  all: match goal with |- context [bresenham_walk ?steep] =>
         pose proof (bresenham_walk_fits steep u0 v0 us vs du dv t Hd Hdu Ht Hus Hvs ltac:(lia) ltac:(lia)
           ltac:(lia) ltac:(lia) (Z.to_nat (endd - first)) first F ltac:(lia)) as W end.
  all: destruct (enter du dv t first); exact W.
Qed.
