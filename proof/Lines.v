(** The DDA and Bresenham's drawer (crates/core/src/line/dda.rs, crates/core/src/line/bresenham.rs), loop by loop: one list of
    pixels, all octants, all windows, both directions. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid.
Import ListNotations.
Open Scope Z_scope.

(** ** The specification *)

Definition sgn (n : Z) : Z := if n <? 0 then -1 else 1.
Definition tie (n : Z) : Z := if n <? 0 then 1 else 0.

(** Pixels risen after i of du steps with dv to rise: i dv / du to the nearest, a tie up, or down
    when the line is drawn backwards. *)
Definition rise_at (du dv tie i : Z) : Z :=
  if du =? 0 then 0 else (2 * i * dv + du - tie) / (2 * du).

Definition line_pixel (a b : point) (i : Z) : point :=
  let dx := X b - X a in
  let dy := Y b - Y a in
  if Z.abs dx <? Z.abs dy
  then Pt (X a + sgn dx * rise_at (Z.abs dy) (Z.abs dx) (tie dy) i) (Y a + sgn dy * i)
  else Pt (X a + sgn dx * i) (Y a + sgn dy * rise_at (Z.abs dx) (Z.abs dy) (tie dx) i).

Fixpoint steps (from : Z) (n : nat) : list Z :=
  match n with O => [] | Datatypes.S n => from :: steps (from + 1) n end.

Definition range (first endd : Z) : list Z := steps first (Z.to_nat (endd - first)).

Definition line_length (a b : point) : Z := Z.max (Z.abs (X b - X a)) (Z.abs (Y b - Y a)).

Definition line (a b : point) : list point :=
  map (line_pixel a b) (range 0 (line_length a b + 1)).

Definition in_window (r : rect) (p : point) : bool := in_rect r (X p) (Y p).

(** ** The DDA (crates/core/src/line/dda.rs) *)

Record height := Height { whole : Z; part : Z }.

Record slope := Slope {
  origin : point; x_is_major : bool; forward : Z; upward : Z; length : Z; rise : Z }.

Definition slope_of (a b : point) : slope :=
  let dx := X b - X a in
  let dy := Y b - Y a in
  let x_is_major := Z.abs dy <=? Z.abs dx in
  let major := if x_is_major then dx else dy in
  let minor := if x_is_major then dy else dx in
  Slope a x_is_major (if major <? 0 then -1 else 1) (if minor <? 0 then -1 else 1)
    (Z.abs major) (Z.abs minor).

Definition height_at (s : slope) (step : Z) : height :=
  if length s =? 0 then Height 0 0
  else let n := step * rise s in Height (n / length s) (n mod length s).

Definition next (s : slope) (t : height) : height :=
  let p := part t + rise s in
  if (length s <=? p) && (0 <? length s)
  then Height (whole t + 1) (p - length s) else Height (whole t) p.

Definition round (s : slope) (t : height) : Z :=
  let up := if 0 <? forward s then length s <=? 2 * part t else length s <? 2 * part t in
  whole t + (if up && (0 <? length s) then 1 else 0).

Definition pixel (s : slope) (step height : Z) : point :=
  let major := forward s * step in
  let minor := upward s * height in
  if x_is_major s then Pt (X (origin s) + major) (Y (origin s) + minor)
  else Pt (X (origin s) + minor) (Y (origin s) + major).

(** The half-open range of coordinates, as distances from start in direction sign. *)
Definition offsets (low high start sign : Z) : Z * Z :=
  if 0 <? sign then (low - start, high - start) else (start - high + 1, start - low + 1).

Fixpoint bisect (f : Z -> Z) (wanted : Z) (fuel : nat) (low high : Z) : Z :=
  match fuel with
  | O => low
  | Datatypes.S fuel =>
      if low <? high then
        let middle := low + (high - low) / 2 in
        if f middle <? wanted then bisect f wanted fuel (middle + 1) high
        else bisect f wanted fuel low middle
      else low
  end.

Definition first_at_height (s : slope) (first endd wanted : Z) : Z :=
  bisect (fun i => round s (height_at s i)) wanted (Z.to_nat (Z.log2 (endd - first) + 1)) first endd.

Definition steps_within (s : slope) (r : rect) : Z * Z :=
  let ox := X (origin s) in
  let oy := Y (origin s) in
  let major := if x_is_major s then offsets (x0 r) (x1 r) ox (forward s)
               else offsets (y0 r) (y1 r) oy (forward s) in
  let minor := if x_is_major s then offsets (y0 r) (y1 r) oy (upward s)
               else offsets (x0 r) (x1 r) ox (upward s) in
  let first := Z.max (fst major) 0 in
  let endd := Z.min (snd major) (length s + 1) in
  if (endd <=? first) || (snd minor <=? fst minor) then (0, 0)
  else (first_at_height s first endd (fst minor), first_at_height s first endd (snd minor)).

Fixpoint dda_walk (s : slope) (n : nat) (step : Z) (t : height) : list point :=
  match n with
  | O => []
  | Datatypes.S n => pixel s step (round s t) :: dda_walk s n (step + 1) (next s t)
  end.

Definition dda (a b : point) (r : rect) : list point :=
  let s := slope_of a b in
  let '(first, endd) := steps_within s r in
  dda_walk s (Z.to_nat (endd - first)) first (height_at s first).

(** ** Bresenham (crates/core/src/line/bresenham.rs) *)

Definition max_i64 : Z := 2 ^ 63 - 1.

(** The first step at which the line has risen by at least [wanted] pixels. *)
Definition first_step_at (du dv tie wanted : Z) : Z :=
  if wanted <=? 0 then 0
  else if (dv =? 0) || (dv <? wanted) then max_i64
  else Z.quot (2 * du * wanted - du + tie + 2 * dv - 1) (2 * dv).

(** Pixels risen at a step, and the decision for the next one. *)
Definition enter (du dv tie step : Z) : Z * Z :=
  if du =? 0 then (0, -1)
  else
    let twice := 2 * step * dv in
    let risen := Z.quot (twice + du - tie) (2 * du) in
    (risen, twice + 2 * dv - du - tie - 2 * du * risen).

Section Bresenham.
Variables (steep : bool) (u v u_sign v_sign du dv : Z).

Fixpoint bresenham_walk (n : nat) (step risen decision : Z) : list point :=
  match n with
  | O => []
  | Datatypes.S n =>
      let major := u + u_sign * step in
      let minor := v + v_sign * risen in
      (if steep then Pt minor major else Pt major minor) ::
      bresenham_walk n (step + 1) (if 0 <=? decision then risen + 1 else risen)
        ((if 0 <=? decision then decision - 2 * du else decision) + 2 * dv)
  end.
End Bresenham.

Definition bresenham (a b : point) (r : rect) : list point :=
  let steep := Z.abs (X b - X a) <? Z.abs (Y b - Y a) in
  let u0 := if steep then Y a else X a in
  let u1 := if steep then Y b else X b in
  let v0 := if steep then X a else Y a in
  let v1 := if steep then X b else Y b in
  let du := Z.abs (u1 - u0) in
  let dv := Z.abs (v1 - v0) in
  let backwards := u1 <? u0 in
  let u_sign := if backwards then -1 else 1 in
  let v_sign := if v1 <? v0 then -1 else 1 in
  let tie := if backwards then 1 else 0 in
  let u_window := if steep then offsets (y0 r) (y1 r) u0 u_sign else offsets (x0 r) (x1 r) u0 u_sign in
  let v_window := if steep then offsets (x0 r) (x1 r) v0 v_sign else offsets (y0 r) (y1 r) v0 v_sign in
  let first := Z.max (Z.max (first_step_at du dv tie (fst v_window)) (fst u_window)) 0 in
  let endd := Z.min (Z.min (first_step_at du dv tie (snd v_window)) (snd u_window)) (du + 1) in
  if (endd <=? first) || (snd v_window <=? fst v_window) then []
  else
    let '(risen, decision) := enter du dv tie first in
    bresenham_walk steep u0 v0 u_sign v_sign du dv (Z.to_nat (endd - first)) first risen decision.

(** ** Both walks compute the same heights *)

Lemma rise_at_le du dv t i r : 0 < du -> (r <= rise_at du dv t i <-> 2 * du * r <= 2 * i * dv + du - t).
Proof. intros. unfold rise_at. destruct (Z.eqb_spec du 0); [lia |]. apply floor_le. lia. Qed.

(** The specification in the oracle's words: no pixel is nearer, and a tie goes on (or stays). *)
Theorem rise_at_nearest du dv t i : 0 < du -> 0 <= t <= 1 ->
  - du - t < 2 * (du * rise_at du dv t i - i * dv) <= du - t.
Proof.
  intros Hd Ht. pose proof (rise_at_le du dv t i (rise_at du dv t i) Hd).
  pose proof (rise_at_le du dv t i (rise_at du dv t i + 1) Hd). lia.
Qed.

Lemma rise_at_unique du dv t i r : 0 < du ->
  2 * du * r <= 2 * i * dv + du - t < 2 * du * (r + 1) -> rise_at du dv t i = r.
Proof.
  intros Hd H. pose proof (rise_at_le du dv t i r Hd). pose proof (rise_at_le du dv t i (r + 1) Hd). lia.
Qed.

Lemma rise_at_mono du dv t i j : 0 <= du -> 0 <= dv -> i <= j -> rise_at du dv t i <= rise_at du dv t j.
Proof.
  intros. unfold rise_at. destruct (Z.eqb_spec du 0); [lia |]. apply Z.div_le_mono; nia.
Qed.

Lemma rise_at_range du dv t i : 0 <= dv <= du -> 0 <= t <= 1 -> 0 <= i <= du ->
  0 <= rise_at du dv t i <= dv.
Proof.
  intros. destruct (Z.eq_dec du 0) as [-> |]; [cbn; lia |].
  assert (0 <= i * dv) by (apply Z.mul_nonneg_nonneg; lia).
  assert (i * dv <= du * dv) by (apply Z.mul_le_mono_nonneg_r; lia).
  pose proof (rise_at_le du dv t i 0 ltac:(lia)). pose proof (rise_at_le du dv t i (dv + 1) ltac:(lia)). lia.
Qed.

Lemma slope_of_ok a b : let s := slope_of a b in
  0 <= rise s <= length s /\ (forward s = 1 \/ forward s = -1) /\ (upward s = 1 \/ upward s = -1).
Proof.
  unfold slope_of; cbn [rise length forward upward].
  destruct (Z.leb_spec (Z.abs (Y b - Y a)) (Z.abs (X b - X a)));
    repeat split; try lia; destruct (_ <? 0); auto.
Qed.

(** The DDA: adding the slope is multiplying by the step. *)
Theorem next_is_height s i : 0 <= rise s <= length s ->
  next s (height_at s i) = height_at s (i + 1).
Proof.
  intros Hs. unfold next, height_at. destruct (Z.eqb_spec (length s) 0) as [H0 | H0].
  - cbn [part whole]. rewrite H0, andb_false_r. f_equal. lia.
  - cbn [part whole]. set (L := length s) in *.
    pose proof (Z.div_mod (i * rise s) L H0). pose proof (Z.mod_pos_bound (i * rise s) L ltac:(lia)).
    destruct (Z.leb_spec L ((i * rise s) mod L + rise s)), (Z.ltb_spec 0 L); try lia; cbn [andb]; f_equal.
    + apply Z.div_unique with ((i * rise s) mod L + rise s - L); lia.
    + apply Z.mod_unique with ((i * rise s) / L + 1); lia.
    + apply Z.div_unique with ((i * rise s) mod L + rise s); lia.
    + apply Z.mod_unique with ((i * rise s) / L); lia.
Qed.

Theorem round_is_rise s i : 0 <= rise s <= length s -> (forward s = 1 \/ forward s = -1) ->
  round s (height_at s i) = rise_at (length s) (rise s) (tie (forward s)) i.
Proof.
  intros Hs Hf. destruct (Z.eq_dec (length s) 0) as [H0 | H0].
  - unfold round, height_at, rise_at. rewrite H0. cbn. rewrite andb_false_r. reflexivity.
  - symmetry. apply rise_at_unique; [lia |]. unfold round, height_at.
    destruct (Z.eqb_spec (length s) 0); [lia |]. cbn [part whole]. set (L := length s) in *.
    pose proof (Z.div_mod (i * rise s) L H0). pose proof (Z.mod_pos_bound (i * rise s) L ltac:(lia)).
    destruct Hf as [-> | ->]; cbn [Z.ltb Z.compare tie];
      destruct (Z.ltb_spec 0 L); try lia; rewrite andb_true_r; decide_all; nia.
Qed.

(** Bresenham: the decision is what the specification says of the next step. *)
Lemma enter_spec du dv t i : 0 < du -> 0 <= dv -> 0 <= t <= 1 -> 0 <= i ->
  enter du dv t i = (rise_at du dv t i, 2 * (i + 1) * dv - du - t - 2 * du * rise_at du dv t i).
Proof.
  intros. unfold enter, rise_at. destruct (Z.eqb_spec du 0); [lia |].
  rewrite Z.quot_div_nonneg by nia. f_equal. ring.
Qed.

Lemma bresenham_walk_spec steep u v us vs du dv t : 0 <= dv <= du -> 0 <= t <= 1 -> forall n i, 0 <= i ->
  i + Z.of_nat n <= du + 1 ->
  (let '(risen, decision) := enter du dv t i in bresenham_walk steep u v us vs du dv n i risen decision) =
  map (fun i => let major := u + us * i in let minor := v + vs * rise_at du dv t i in
                if steep then Pt minor major else Pt major minor) (steps i n).
Proof.
  intros Hdv Ht. destruct (Z.eq_dec du 0) as [D0 | D0].
  - intros [| [| n]] i Hi Hn; unfold enter; rewrite D0; cbn; try reflexivity; lia.
  - induction n as [| n IH]; intros i Hi Hn; rewrite enter_spec by lia; cbn [bresenham_walk steps map]; [reflexivity |].
    f_equal. rewrite <- IH by lia. rewrite enter_spec by lia.
    set (r := rise_at du dv t i).
    pose proof (rise_at_le du dv t i r ltac:(lia)). pose proof (rise_at_le du dv t i (r + 1) ltac:(lia)).
    assert (N : rise_at du dv t (i + 1) = if 0 <=? 2 * (i + 1) * dv - du - t - 2 * du * r then r + 1 else r).
    { apply rise_at_unique; [lia |]. decide_all; lia. }
    rewrite N. decide_all; f_equal; ring.
Qed.

Lemma dda_walk_spec s : 0 <= rise s <= length s -> (forward s = 1 \/ forward s = -1) -> forall n i,
  dda_walk s n i (height_at s i) =
  map (fun i => pixel s i (rise_at (length s) (rise s) (tie (forward s)) i)) (steps i n).
Proof.
  intros Hs Hf. induction n as [| n IH]; intros i; cbn [dda_walk steps map]; [reflexivity |].
  rewrite round_is_rise, next_is_height, IH by assumption. reflexivity.
Qed.

(** ** Windows: what is skipped is what lies outside *)

Lemma filter_steps (f : Z -> bool) first endd : forall n lo,
  (forall i, lo <= i < lo + Z.of_nat n -> f i = (first <=? i) && (i <? endd)) ->
  filter f (steps lo n) =
  range (Z.max lo first) (Z.min endd (lo + Z.of_nat n)).
Proof.
  induction n as [| n IH]; intros lo Hf; cbn [steps filter].
  - unfold range. replace (Z.to_nat _) with O by lia. reflexivity.
  - rewrite Hf, IH by (intros; try apply Hf; lia). unfold range.
    destruct (Z.leb_spec first lo), (Z.ltb_spec lo endd); cbn [andb].
    + replace (Z.to_nat (Z.min endd (lo + Z.of_nat (Datatypes.S n)) - Z.max lo first))
        with (Datatypes.S (Z.to_nat (Z.min endd (lo + 1 + Z.of_nat n) - Z.max (lo + 1) first))) by lia.
      cbn [steps]. replace (Z.max lo first) with lo by lia.
      replace (Z.max (lo + 1) first) with (lo + 1) by lia. reflexivity.
    + replace (Z.to_nat _) with O by lia. replace (Z.to_nat _) with O by lia. reflexivity.
    + replace (Z.max (lo + 1) first) with (Z.max lo first) by lia.
      replace (lo + 1 + Z.of_nat n) with (lo + Z.of_nat (Datatypes.S n)) by lia. reflexivity.
    + replace (Z.to_nat _) with O by lia. replace (Z.to_nat _) with O by lia. reflexivity.
Qed.

Lemma range_empty first endd : endd <= first -> range first endd = [].
Proof. intros. unfold range. replace (Z.to_nat (endd - first)) with O by lia. reflexivity. Qed.

Lemma filter_map {A B} (f : B -> bool) (g : A -> B) l :
  filter f (map g l) = map g (filter (fun a => f (g a)) l).
Proof. induction l as [| a l IH]; cbn; [reflexivity |]. destruct (f (g a)); cbn; rewrite IH; reflexivity. Qed.

Lemma in_offsets low high start sign i : sign = 1 \/ sign = -1 ->
  ((low <=? start + sign * i) && (start + sign * i <? high)) =
  ((fst (offsets low high start sign) <=? i) && (i <? snd (offsets low high start sign))).
Proof.
  unfold offsets. intros [-> | ->]; cbn [Z.ltb Z.compare fst snd]; decide_all; cbn [andb]; lia.
Qed.

(** Bisection finds the first place where a rising function reaches a value. *)
Lemma bisect_spec f wanted : (forall i j, i <= j -> f i <= f j) -> forall fuel low high,
  low <= high < low + 2 ^ Z.of_nat fuel ->
  low <= bisect f wanted fuel low high <= high /\
  (forall i, low <= i < high -> (wanted <= f i <-> bisect f wanted fuel low high <= i)).
Proof.
  intros Hf. induction fuel as [| fuel IH]; intros low high H.
  - cbn in *. split; intros; lia.
  - cbn [bisect]. rewrite Nat2Z.inj_succ, Z.pow_succ_r in H by lia.
    destruct (Z.ltb_spec low high); [| split; intros; lia].
    pose proof (Z.div_mod (high - low) 2 ltac:(lia)). pose proof (Z.mod_pos_bound (high - low) 2 ltac:(lia)).
    set (middle := low + (high - low) / 2) in *.
    destruct (Z.ltb_spec (f middle) wanted).
    + destruct (IH (middle + 1) high) as [R S]; [lia |]. split; [lia |]. intros i Hi.
      destruct (Z.le_gt_cases i middle); [| apply S; lia].
      pose proof (Hf i middle ltac:(lia)). lia.
    + destruct (IH low middle) as [R S]; [lia |]. split; [lia |]. intros i Hi.
      destruct (Z.lt_ge_cases i middle); [apply S; lia |].
      pose proof (Hf middle i ltac:(lia)). lia.
Qed.

Lemma first_at_height_spec s first endd wanted : 0 <= rise s <= length s ->
  (forward s = 1 \/ forward s = -1) -> first < endd ->
  first <= first_at_height s first endd wanted <= endd /\
  forall i, first <= i < endd ->
    (wanted <= rise_at (length s) (rise s) (tie (forward s)) i <-> first_at_height s first endd wanted <= i).
Proof.
  intros Hs Hf H. unfold first_at_height.
  destruct (bisect_spec (fun i => round s (height_at s i)) wanted) with
    (fuel := Z.to_nat (Z.log2 (endd - first) + 1)) (low := first) (high := endd) as [B C].
  - intros. rewrite !round_is_rise by assumption. apply rise_at_mono; lia.
  - pose proof (Z.log2_nonneg (endd - first)). rewrite Z2Nat.id by lia.
    pose proof (Z.log2_spec (endd - first) ltac:(lia)). rewrite Z.add_1_r. lia.
  - split; [exact B |]. intros i Hi. specialize (C i Hi). cbv beta in C.
    rewrite round_is_rise in C by assumption. exact C.
Qed.

Lemma first_step_at_spec du dv t wanted i : 0 <= dv <= du -> du < max_i64 -> 0 <= t <= 1 ->
  0 <= i <= du -> (wanted <= rise_at du dv t i <-> first_step_at du dv t wanted <= i).
Proof.
  intros Hdv Hd Ht Hi. pose proof (rise_at_range du dv t i Hdv Ht Hi). unfold first_step_at.
  destruct (Z.leb_spec wanted 0); [lia |].
  destruct (Z.eqb_spec dv 0); cbn [orb]; [lia |].
  destruct (Z.ltb_spec dv wanted); [lia |].
  rewrite rise_at_le by lia. rewrite Z.quot_div_nonneg by nia.
  pose proof (floor_lt (2 * du * wanted - du + t + 2 * dv - 1) (2 * dv) (i + 1) ltac:(lia)). lia.
Qed.

Lemma tie_sgn n : tie (if n <? 0 then -1 else 1) = if n <? 0 then 1 else 0.
Proof. destruct (n <? 0); reflexivity. Qed.

(** Both drawers draw the line's pixels in the window, in order, and nothing else. *)
Theorem dda_draws a b r : dda a b r = filter (in_window r) (line a b).
Proof.
  unfold dda. destruct (slope_of_ok a b) as (Hs & Hf & Hu). set (s := slope_of a b) in *.
  assert (P : forall i, line_pixel a b i = pixel s i (rise_at (length s) (rise s) (tie (forward s)) i)).
  { intros i. unfold line_pixel, pixel. subst s. unfold slope_of; cbn [x_is_major origin forward upward length rise].
    rewrite tie_sgn, Z.leb_antisym. unfold sgn, tie.
    destruct (Z.abs (X b - X a) <? Z.abs (Y b - Y a)); reflexivity. }
  assert (L : length s = line_length a b).
  { subst s. unfold slope_of, line_length; cbn [length]. decide_all; lia. }
  clearbody s. unfold line. rewrite filter_map, <- L, (map_ext _ _ P).
  destruct (steps_within s r) as [first endd] eqn:W.
  rewrite dda_walk_spec by assumption. f_equal.
  unfold range at 1. rewrite (filter_steps _ first endd).
  2: { intros i Hi. rewrite P. unfold in_window, in_rect, pixel. unfold steps_within in W.
       set (h := rise_at _ _ _ _).
       destruct (x_is_major s); cbn [X Y]; rewrite !in_offsets by assumption.
       all: apply eq_true_iff_eq; rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt.
       all: match type of W with (if (?e <=? ?f) || (?n <=? ?m) then _ else _) = _ =>
              destruct (Z.leb_spec e f); cbn [orb] in W; [| destruct (Z.leb_spec n m)];
              injection W as <- <-; [lia | lia |];
              destruct (first_at_height_spec s f e m) as [A1 A2]; try assumption;
              destruct (first_at_height_spec s f e n) as [B1 B2]; try assumption;
              specialize (A2 i); specialize (B2 i); fold h in A2, B2 end.
       all: rewrite Z.add_0_l, Z2Nat.id in Hi by lia.
       all: lia. }
  assert (B : 0 <= first /\ endd <= length s + 1).
  { unfold steps_within in W.
    match type of W with (if (?e <=? ?f) || (?n <=? ?m) then _ else _) = _ =>
      destruct (Z.leb_spec e f); cbn [orb] in W; [| destruct (Z.leb_spec n m)];
      injection W as <- <-; [lia | lia |];
      destruct (first_at_height_spec s f e m) as [A1 _]; try assumption;
      destruct (first_at_height_spec s f e n) as [B1 _]; try assumption end. lia. }
  unfold range. rewrite Z2Nat.id by lia. f_equal; [lia | f_equal; lia].
Qed.

Theorem bresenham_draws a b r : line_length a b < max_i64 ->
  bresenham a b r = filter (in_window r) (line a b).
Proof.
  intros Hlen. unfold bresenham, line, line_length in *. rewrite filter_map.
  set (dx := X b - X a) in *. set (dy := Y b - Y a) in *.
  set (steep := Z.abs dx <? Z.abs dy).
  set (u0 := if steep then Y a else X a). set (u1 := if steep then Y b else X b).
  set (v0 := if steep then X a else Y a). set (v1 := if steep then X b else Y b).
  set (du := Z.abs (u1 - u0)). set (dv := Z.abs (v1 - v0)).
  set (t := if u1 <? u0 then 1 else 0).
  set (us := if u1 <? u0 then -1 else 1). set (vs := if v1 <? v0 then -1 else 1).
  assert (Hd : 0 <= dv <= du /\ Z.max (Z.abs dx) (Z.abs dy) = du).
  { subst du dv u0 u1 v0 v1 steep dx dy. decide_all; lia. }
  assert (Ht : 0 <= t <= 1) by (subst t; destruct (u1 <? u0); lia).
  assert (Hus : us = 1 \/ us = -1) by (subst us; destruct (u1 <? u0); auto).
  assert (Hvs : vs = 1 \/ vs = -1) by (subst vs; destruct (v1 <? v0); auto).
  assert (P : forall i, line_pixel a b i =
    let major := u0 + us * i in let minor := v0 + vs * rise_at du dv t i in
    if steep then Pt minor major else Pt major minor).
  { intros i. unfold line_pixel. fold dx dy steep.
    subst du dv us vs t u0 u1 v0 v1. unfold sgn, tie.
    assert (N : forall p q, (p <? q) = (p - q <? 0)) by (intros; apply eq_true_iff_eq; rewrite !Z.ltb_lt; lia).
    rewrite (N (if steep then Y b else X b)), (N (if steep then X b else Y b)).
    destruct steep; fold dx dy; reflexivity. }
  clearbody du dv t us vs u0 v0. clear u1 v1. destruct Hd as [Hd Hmax].
  rewrite Hmax in *. clear Hmax. clearbody dx dy.
  set (uw := if steep then offsets (y0 r) (y1 r) u0 us else offsets (x0 r) (x1 r) u0 us).
  set (vw := if steep then offsets (x0 r) (x1 r) v0 vs else offsets (y0 r) (y1 r) v0 vs).
  set (first := Z.max (Z.max _ _) 0). set (endd := Z.min _ (du + 1)).
  rewrite (map_ext _ _ P). unfold range.
  rewrite (filter_steps _ first (if snd vw <=? fst vw then first else endd)).
  - rewrite Z.add_0_l, Z2Nat.id by lia.
    assert (F : 0 <= first) by (subst first; lia). assert (G : endd <= du + 1) by (subst endd; lia).
    destruct (Z.leb_spec endd first); cbn [orb]; [| destruct (Z.leb_spec (snd vw) (fst vw))].
    + rewrite range_empty by (destruct (snd vw <=? fst vw); lia). reflexivity.
    + rewrite range_empty by lia. reflexivity.
    + rewrite (bresenham_walk_spec steep u0 v0 us vs du dv t Hd Ht) by lia.
      unfold range. do 2 f_equal; lia.
  - intros i Hi. rewrite Z.add_0_l, Z2Nat.id in Hi by lia. rewrite P. cbv zeta.
    pose proof (first_step_at_spec du dv t (fst vw) i Hd ltac:(lia) Ht ltac:(lia)) as A.
    pose proof (first_step_at_spec du dv t (snd vw) i Hd ltac:(lia) Ht ltac:(lia)) as B.
    subst first endd uw vw. unfold in_window, in_rect.
    clear P. clearbody steep. revert A B. set (h := rise_at du dv t i). clearbody h.
    destruct steep; cbn [X Y]; intros A B; rewrite !in_offsets by assumption;
      apply eq_true_iff_eq; rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt; decide_all; lia.
Qed.

Corollary dda_is_bresenham a b r : line_length a b < max_i64 -> dda a b r = bresenham a b r.
Proof. intros. rewrite dda_draws, bresenham_draws by assumption. reflexivity. Qed.

(** ** The same pixels from either end *)

Lemma rise_at_reverse du dv i : 0 <= du ->
  rise_at du dv 0 i + rise_at du dv 1 (du - i) = if du =? 0 then 0 else dv.
Proof.
  intros. destruct (Z.eqb_spec du 0) as [-> |]; [reflexivity |].
  pose proof (rise_at_le du dv 0 i (rise_at du dv 0 i) ltac:(lia)).
  pose proof (rise_at_le du dv 0 i (rise_at du dv 0 i + 1) ltac:(lia)).
  enough (rise_at du dv 1 (du - i) = dv - rise_at du dv 0 i) by lia.
  apply rise_at_unique; lia.
Qed.

Lemma line_pixel_reverse a b i : 0 <= i <= line_length a b ->
  line_pixel b a (line_length a b - i) = line_pixel a b i.
Proof.
  unfold line_pixel, line_length. intros Hi. revert Hi.
  replace (X a - X b) with (- (X b - X a)) by ring. replace (Y a - Y b) with (- (Y b - Y a)) by ring.
  replace (X b) with (X a + (X b - X a)) by ring. replace (Y b) with (Y a + (Y b - Y a)) by ring.
  set (dx := X b - X a). set (dy := Y b - Y a). clearbody dx dy.
  replace (X a + dx - X a) with dx by ring. replace (Y a + dy - Y a) with dy by ring.
  rewrite !Z.abs_opp.
  assert (M : forall d e, Z.abs e <= Z.abs d ->
    e + sgn (- e) * rise_at (Z.abs d) (Z.abs e) (tie (- d)) (Z.abs d - i) =
    sgn e * rise_at (Z.abs d) (Z.abs e) (tie d) i).
  { intros d e He. unfold sgn, tie.
    pose proof (rise_at_reverse (Z.abs d) (Z.abs e) i ltac:(lia)) as R1.
    pose proof (rise_at_reverse (Z.abs d) (Z.abs e) (Z.abs d - i) ltac:(lia)) as R2.
    replace (Z.abs d - (Z.abs d - i)) with i in R2 by lia.
    destruct (Z.eqb_spec (Z.abs d) 0) as [e0 | ].
    - rewrite e0 in *. unfold rise_at. cbn. decide_all; lia.
    - destruct (Z.eq_dec e 0) as [-> |].
      + assert (Z0' : forall t j, 0 <= t <= 1 -> rise_at (Z.abs d) 0 t j = 0) by (intros; apply rise_at_unique; lia).
        cbn [Z.abs]. decide_all; rewrite !Z0' by lia; lia.
      + decide_all; lia. }
  assert (N : forall d, d <> 0 -> d + sgn (- d) * (Z.abs d - i) = sgn d * i)
    by (intros d Hd; unfold sgn; decide_all; lia).
  intros Hi. destruct (Z.ltb_spec (Z.abs dx) (Z.abs dy)).
  - replace (Z.max _ _) with (Z.abs dy) by lia. f_equal.
    + specialize (M dy dx ltac:(lia)). lia.
    + specialize (N dy ltac:(lia)). lia.
  - replace (Z.max _ _) with (Z.abs dx) by lia. destruct (Z.eq_dec dx 0) as [-> |].
    + assert (dy = 0) as -> by lia. assert (i = 0) as -> by lia. cbn. f_equal; lia.
    + f_equal.
      * specialize (N dx ltac:(lia)). lia.
      * specialize (M dx dy ltac:(lia)). lia.
Qed.

Lemma map_steps {A} (f g : Z -> A) c : (forall i, g i = f (c - i)) -> forall n lo,
  map g (steps lo n) = rev (map f (steps (c - lo - Z.of_nat n + 1) n)).
Proof.
  intros Hg. induction n as [| n IH]; intros lo; [reflexivity |].
  assert (Snoc : forall m from, steps from (Datatypes.S m) = steps from m ++ [from + Z.of_nat m]).
  { induction m as [| m IHm]; intros from; [cbn; f_equal; lia |].
    change (steps from (Datatypes.S (Datatypes.S m))) with (from :: steps (from + 1) (Datatypes.S m)).
    rewrite IHm. cbn [steps app]. do 3 f_equal. lia. }
  rewrite (Snoc n (c - lo - Z.of_nat (Datatypes.S n) + 1)), map_app, rev_app_distr.
  cbn [steps map rev app]. f_equal.
  - rewrite Hg. f_equal. lia.
  - rewrite IH. do 3 f_equal. lia.
Qed.

(** AB = BA: drawn from the other end, the line is the same list of pixels, reversed. *)
Theorem line_reverse a b : line b a = rev (line a b).
Proof.
  assert (L : line_length b a = line_length a b) by (unfold line_length; lia).
  unfold line. rewrite L. set (n := line_length a b). assert (Hn : 0 <= n) by (unfold n, line_length; lia).
  rewrite <- (map_ext_in (fun i => line_pixel b a (n - (n - i)))).
  2: { intros i _. f_equal. lia. }
  unfold range. rewrite (map_steps (fun i => line_pixel b a (n - i)) _ n) by reflexivity.
  f_equal. replace (n - 0 - Z.of_nat (Z.to_nat (n + 1 - 0)) + 1) with 0 by lia.
  apply map_ext_in. intros i Hi. apply line_pixel_reverse.
  assert (R : forall m lo, In i (steps lo m) -> lo <= i < lo + Z.of_nat m).
  { clear. induction m as [| m IH]; cbn [steps In]; intros lo; [tauto |].
    intros [<- | H]; [| apply IH in H]; lia. }
  apply R in Hi. fold n. lia.
Qed.

Corollary dda_reverse a b r : dda b a r = rev (dda a b r).
Proof.
  rewrite !dda_draws, line_reverse. generalize (line a b). intros l.
  induction l as [| p l IH]; cbn; [reflexivity |].
  rewrite filter_app, IH. cbn. destruct (in_window r p); cbn; [reflexivity | apply app_nil_r].
Qed.
