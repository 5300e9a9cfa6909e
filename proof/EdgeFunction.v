(** The edge-function engine (crates/core/src/raster/edge_function.rs), loop by loop, in words of any width. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid.
Import ListNotations.
Open Scope Z_scope.

(** ** The stepped integer E' = floor((E - bias) / S) *)

Definition enter (h : Z) (a b : point) (px py : Z) : Z :=
  (E a b (centre h px) (centre h py) - bias a b) / (2 * h).

Definition right (a b : point) : Z := - (Y b - Y a).
Definition down (a b : point) : Z := X b - X a.

(** E' grows by exactly -dy to the right and by dx down, and its sign is the decision. *)
Theorem enter_right h a b px py : 0 < h ->
  enter h a b (px + 1) py = enter h a b px py + right a b.
Proof.
  intros. unfold enter, right, E, centre. rewrite <- floor_shift by lia. f_equal. ring.
Qed.

Theorem enter_down h a b px py : 0 < h ->
  enter h a b px (py + 1) = enter h a b px py + down a b.
Proof.
  intros. unfold enter, down, E, centre. rewrite <- floor_shift by lia. f_equal. ring.
Qed.

Theorem enter_sign h a b px py : 0 < h ->
  (enter h a b px py <? 0) = negb (test a b (centre h px) (centre h py)).
Proof.
  intros. unfold enter, test. rewrite Z.leb_antisym, negb_involutive.
  apply eq_true_iff_eq. rewrite !Z.ltb_lt, floor_lt by lia. lia.
Qed.

(** ** The walk over the box *)

(** A machine word of [bits] bits wraps around. *)
Definition wrap (bits z : Z) : Z := (z + 2 ^ (bits - 1)) mod 2 ^ bits - 2 ^ (bits - 1).

Definition triple := (Z * Z * Z)%type.

Definition out (e : triple) : bool := let '(e0, e1, e2) := e in Z.lor (Z.lor e0 e1) e2 <? 0.

Section Walk.
Variable bits : Z.

Definition add (e f : triple) : triple :=
  let '(e0, e1, e2) := e in let '(f0, f1, f2) := f in
  (wrap bits (e0 + f0), wrap bits (e1 + f1), wrap bits (e2 + f2)).

(** While (e0 | e1 | e2) is negative, or while it is not, at most n times: go one column right. *)
Fixpoint run (while_out : bool) (rights : triple) (n : nat) (x : Z) (e : triple) : nat * Z * triple :=
  match n with
  | O => (O, x, e)
  | S m => if Bool.eqb (out e) while_out then run while_out rights m (x + 1) (add e rights)
           else (n, x, e)
  end.

Fixpoint walk (rights downs : triple) (width : nat) (n : nat) (x y : Z) (row : triple) : list span :=
  match n with
  | O => []
  | S m =>
      let '(n1, xa, e1) := run true rights width x row in
      let '(_, xb, _) := run false rights n1 xa e1 in
      (if xa <? xb then [(y, xa, xb)] else []) ++
      match m with
      | O => []
      | S _ => walk rights downs width m x (y + 1) (add row downs)
      end
  end.

(** The pixels of the window whose centres lie in the bounding box of the corners. *)
Definition pixel_box (h : Z) (a b c : point) (r : rect) : rect :=
  Rect (Z.max (first_centre h (min3 (X a) (X b) (X c))) (x0 r))
       (Z.max (first_centre h (min3 (Y a) (Y b) (Y c))) (y0 r))
       (Z.min (end_centre h (max3 (X a) (X b) (X c))) (x1 r))
       (Z.min (end_centre h (max3 (Y a) (Y b) (Y c))) (y1 r)).

Definition each (f : point -> point -> Z) (a b c : point) : triple :=
  (wrap bits (f b c), wrap bits (f c a), wrap bits (f a b)).

Definition cover_in (h : Z) (a b c : point) (bounds : rect) : list span :=
  let r := pixel_box h a b c bounds in
  if (x1 r <=? x0 r) || (y1 r <=? y0 r) then []
  else
    let area := area2 a b c in
    if area =? 0 then []
    else
      let b' := if 0 <? area then b else c in
      let c' := if 0 <? area then c else b in
      walk (each right a b' c') (each down a b' c')
        (Z.to_nat (x1 r - x0 r)) (Z.to_nat (y1 r - y0 r)) (x0 r) (y0 r)
        (each (fun p q => enter h p q (x0 r) (y0 r)) a b' c').
End Walk.

(** ** Words that are wide enough *)

Definition fits (bits z : Z) : Prop := - 2 ^ (bits - 1) <= z < 2 ^ (bits - 1).

Lemma wrap_fits bits z : 0 < bits -> fits bits z -> wrap bits z = z.
Proof.
  unfold fits, wrap. intros Hb Hz.
  replace (2 ^ bits) with (2 * 2 ^ (bits - 1)).
  - rewrite Z.mod_small; lia.
  - replace bits with (1 + (bits - 1)) at 2 by lia. rewrite Z.pow_add_r by lia. reflexivity.
Qed.

(** Geometry: with an edge of the box a point of the box spans at most the area of the box.
    E is a sum of x times differences of y that cancel. *)
Lemma E_in_box p q x y lx hx ly hy :
  lx <= X p <= hx -> lx <= X q <= hx -> lx <= x <= hx ->
  ly <= Y p <= hy -> ly <= Y q <= hy -> ly <= y <= hy ->
  - ((hx - lx) * (hy - ly)) <= E p q x y <= (hx - lx) * (hy - ly).
Proof.
  intros.
  replace (E p q x y) with ((X p - lx) * (Y q - y) + (X q - lx) * (y - Y p) + (x - lx) * (Y p - Y q))
    by (unfold E; ring).
  assert (T : forall u d, 0 <= u <= hx - lx ->
    (hx - lx) * Z.min d 0 <= u * d <= (hx - lx) * Z.max d 0) by (intros; nia).
  pose proof (T (X p - lx) (Y q - y)). pose proof (T (X q - lx) (y - Y p)).
  pose proof (T (x - lx) (Y p - Y q)).
  set (m := Z.min (Y q - y) 0 + Z.min (y - Y p) 0 + Z.min (Y p - Y q) 0).
  set (M := Z.max (Y q - y) 0 + Z.max (y - Y p) 0 + Z.max (Y p - Y q) 0).
  assert (ly - hy <= m /\ M <= hy - ly) as [Hm HM] by (subst m M; lia).
  assert ((hx - lx) * (ly - hy) <= (hx - lx) * m) by (apply Z.mul_le_mono_nonneg_l; lia).
  assert ((hx - lx) * M <= (hx - lx) * (hy - ly)) by (apply Z.mul_le_mono_nonneg_l; lia).
  subst m M. lia.
Qed.

(** With (Wx + S) (Wy + S) < S 2^(bits - 1), E' fits the word at every centre of the box and one
    step past its right border, and so do its steps. *)
Definition word_is_wide_enough (h bits : Z) (a b c : point) : Prop :=
  0 < bits /\
  (max3 (X a) (X b) (X c) - min3 (X a) (X b) (X c) + 2 * h) *
  (max3 (Y a) (Y b) (Y c) - min3 (Y a) (Y b) (Y c) + 2 * h) < 2 * h * 2 ^ (bits - 1).

Definition corner (p a b c : point) : Prop := p = a \/ p = b \/ p = c.

Theorem enter_fits h bits a b c p q px py : 0 < h -> word_is_wide_enough h bits a b c ->
  corner p a b c -> corner q a b c ->
  min3 (X a) (X b) (X c) <= centre h px <= max3 (X a) (X b) (X c) + 2 * h ->
  min3 (Y a) (Y b) (Y c) <= centre h py <= max3 (Y a) (Y b) (Y c) ->
  fits bits (enter h p q px py) /\ fits bits (right p q) /\ fits bits (down p q).
Proof.
  intros Hh [Hbits W] Hp Hq Hx Hy.
  set (lx := min3 (X a) (X b) (X c)) in *. set (hx := max3 (X a) (X b) (X c)) in *.
  set (ly := min3 (Y a) (Y b) (Y c)) in *. set (hy := max3 (Y a) (Y b) (Y c)) in *.
  assert (B : forall p, corner p a b c -> lx <= X p <= hx /\ ly <= Y p <= hy)
    by (intros r [-> | [-> | ->]]; unfold lx, hx, ly, hy, min3, max3; lia).
  apply B in Hp, Hq. clear B. clearbody lx hx ly hy.
  pose proof (E_in_box p q (centre h px) (centre h py) lx (hx + 2 * h) ly hy) as EB.
  assert (0 <= bias p q <= 1) by (unfold bias; destruct (_ || _); lia).
  set (P := 2 ^ (bits - 1)) in *.
  set (u := hx - lx + 2 * h) in *. set (v := hy - ly + 2 * h) in *.
  assert (2 * h * v <= u * v) by (apply Z.mul_le_mono_nonneg_r; lia).
  assert (u * (2 * h) <= u * v) by (apply Z.mul_le_mono_nonneg_l; lia).
  assert (v < P) by (apply (Z.mul_lt_mono_pos_l (2 * h)); lia).
  assert (u < P) by (apply (Z.mul_lt_mono_pos_l (2 * h)); lia).
  assert (0 < u * (2 * h)) by nia.
  replace (hx + 2 * h - lx) with u in EB by (unfold u; lia).
  replace (u * (hy - ly)) with (u * v - u * (2 * h)) in EB by (unfold v; ring).
  unfold fits, right, down, enter. fold P.
  rewrite floor_lt, floor_le by lia.
  repeat split; lia.
Qed.

(** ** What it covers *)

(** A half-plane that holds at both ends of a run holds in between. *)
Lemma test_convex h a b i j k y : 0 < h -> i <= j <= k ->
  test a b (centre h i) y = true -> test a b (centre h k) y = true ->
  test a b (centre h j) y = true.
Proof.
  unfold test. rewrite !Z.leb_le. intros Hh Hij Hi Hk.
  assert (step : forall s t, E a b (centre h t) y = E a b (centre h s) y - (Y b - Y a) * (2 * h * (t - s)))
    by (intros; unfold E, centre; ring).
  destruct (Z.le_ge_cases 0 (Y b - Y a)).
  - pose proof (step j k). assert (0 <= (Y b - Y a) * (2 * h * (k - j))) by (repeat apply Z.mul_nonneg_nonneg; lia). lia.
  - pose proof (step i j). assert (0 <= (Y a - Y b) * (2 * h * (j - i))) by (repeat apply Z.mul_nonneg_nonneg; lia). lia.
Qed.

Lemma tests_convex h a b c i j k y : 0 < h -> i <= j <= k ->
  tests a b c (centre h i) y = true -> tests a b c (centre h k) y = true ->
  tests a b c (centre h j) y = true.
Proof.
  intros Hh Hij. rewrite !tests_and. intros (A1 & A2 & A3) (B1 & B2 & B3).
  repeat split; eapply test_convex; eassumption.
Qed.

Section Covers.
Variables (h bits : Z) (a b c : point) (box : rect).
Hypotheses (Hh : 0 < h) (Hbits : 0 < bits).

Let at_ (px py : Z) : triple := each bits (fun p q => enter h p q px py) a b c.
Let covered (px py : Z) : bool := tests a b c (centre h px) (centre h py).
Let rights := each bits right a b c.
Let downs := each bits down a b c.

Hypothesis fits_all : forall p q px py, corner p a b c -> corner q a b c ->
  x0 box <= px <= x1 box -> y0 box <= py < y1 box ->
  fits bits (enter h p q px py) /\ fits bits (right p q) /\ fits bits (down p q).

Let in_box px py := x0 box <= px <= x1 box /\ y0 box <= py < y1 box.

Lemma at_exact px py : in_box px py ->
  at_ px py = (enter h b c px py, enter h c a px py, enter h a b px py) /\
  rights = (right b c, right c a, right a b) /\ downs = (down b c, down c a, down a b).
Proof.
  intros [Hx Hy]. unfold at_, rights, downs, each.
  destruct (fits_all b c px py) as (? & ? & ?), (fits_all c a px py) as (? & ? & ?),
    (fits_all a b px py) as (? & ? & ?); unfold corner; auto.
  rewrite !wrap_fits by assumption. auto.
Qed.

Lemma at_right px py : in_box px py -> in_box (px + 1) py ->
  add bits (at_ px py) rights = at_ (px + 1) py.
Proof.
  intros H0 H1. destruct (at_exact _ _ H0) as (-> & -> & _). unfold at_, each, add.
  rewrite !enter_right by assumption. reflexivity.
Qed.

Lemma at_down px py : in_box px py -> in_box px (py + 1) ->
  add bits (at_ px py) downs = at_ px (py + 1).
Proof.
  intros H0 H1. destruct (at_exact _ _ H0) as (-> & _ & ->). unfold at_, each, add.
  rewrite !enter_down by assumption. reflexivity.
Qed.

Lemma out_at px py : in_box px py -> out (at_ px py) = negb (covered px py).
Proof.
  intros H. destruct (at_exact _ _ H) as (-> & _ & _). unfold out, covered, tests.
  rewrite !negb_andb, <- !enter_sign by assumption.
  apply eq_true_iff_eq. rewrite !orb_true_iff, !Z.ltb_lt, !Z.lor_neg. tauto.
Qed.

Lemma run_spec w py n : forall px, in_box px py -> in_box (px + Z.of_nat n) py ->
  exists m, run bits w rights n px (at_ px py) =
    (m, px + Z.of_nat (n - m), at_ (px + Z.of_nat (n - m)) py) /\ (m <= n)%nat /\
    (forall i, px <= i < px + Z.of_nat (n - m) -> covered i py = negb w) /\
    (m <> O -> covered (px + Z.of_nat (n - m)) py = w).
Proof.
  induction n as [| n IH]; intros px H0 H1; cbn [run].
  - exists O. cbn [Nat.sub]. rewrite Z.add_0_r. repeat split; auto; lia.
  - rewrite out_at by assumption. destruct (Bool.eqb (negb (covered px py)) w) eqn:C.
    + apply eqb_prop in C.
      assert (in_box (px + 1) py) by (unfold in_box in *; lia).
      rewrite at_right by assumption.
      destruct (IH (px + 1)) as (m & -> & Hm & Hall & Hend);
        [assumption | unfold in_box in *; lia |].
      exists m. replace (px + 1 + Z.of_nat (n - m)) with (px + Z.of_nat (S n - m)) in * by lia.
      repeat split; auto. intros i Hi. destruct (Z.eq_dec i px) as [-> |].
      * rewrite <- C, negb_involutive. reflexivity.
      * apply Hall; lia.
    + exists (S n). rewrite Nat.sub_diag, Z.add_0_r. repeat split; try lia.
      intros _. destruct (covered px py), w; try discriminate; reflexivity.
Qed.

Lemma hits_walk width px qx : px + Z.of_nat width = x1 box -> px = x0 box ->
  forall n y qy, y0 box <= y -> y + Z.of_nat n <= y1 box ->
  hits (walk bits rights downs width n px y (at_ px y)) qx qy =
  Z.b2z (((y <=? qy) && (qy <? y + Z.of_nat n)) && (((px <=? qx) && (qx <? x1 box)) && covered qx qy)).
Proof.
  intros Hw Hpx. induction n as [| n IH]; intros y qy Hy Hn; cbn [walk].
  - cbn [hits]. destruct (covered qx qy); decide_all; cbn; lia.
  - destruct (run_spec true y width px) as (m & -> & Hm & Hout & Hin1);
      [unfold in_box; lia | unfold in_box; lia |]. cbv beta iota.
    set (xa := px + Z.of_nat (width - m)) in *.
    destruct (run_spec false y m xa) as (k & -> & Hk & Hin & Hend);
      [unfold in_box; lia | unfold in_box; lia |]. cbv beta iota.
    set (xb := xa + Z.of_nat (m - k)) in *.
    rewrite hits_app.
    match goal with |- hits ?r qx qy + hits ?s qx qy = _ => set (row := r); set (rest := s) end.
    assert (Rest : hits rest qx qy =
      Z.b2z (((y + 1 <=? qy) && (qy <? y + 1 + Z.of_nat n)) &&
             (((px <=? qx) && (qx <? x1 box)) && covered qx qy))).
    { subst rest. destruct n as [| n'].
      - cbn [hits]. destruct (covered qx qy); decide_all; cbn; lia.
      - rewrite at_down by (unfold in_box; lia). apply IH; lia. }
    rewrite Rest. clear Rest IH.
    assert (Row : hits row qx qy =
      Z.b2z ((y =? qy) && (((px <=? qx) && (qx <? x1 box)) && covered qx qy))).
    { subst row. destruct (Z.eqb_spec y qy) as [<- | Hne].
      2: { destruct (xa <? xb); cbn [hits in_span]; [| reflexivity].
           destruct (Z.eqb_spec y qy); [lia | reflexivity]. }
      cbn [andb negb] in *.
      assert (C : covered qx y = true -> px <= qx < x1 box -> xa <= qx < xb).
      { intros HC Hq. split.
        - apply Z.nlt_ge; intros L. rewrite Hout in HC by lia. discriminate.
        - apply Z.nle_gt; intros L. destruct k as [| k']; [lia |].
          specialize (Hend ltac:(lia)).
          destruct (Z.eq_dec xa xb) as [e |].
          + rewrite e in Hin1. rewrite Hin1 in Hend by lia. discriminate.
          + enough (covered xb y = true) by congruence.
            apply (tests_convex h a b c xa xb qx); try lia; [| exact HC].
            apply Hin; lia. }
      assert (C' : xa <= qx < xb -> covered qx y = true) by (intros; apply Hin; assumption).
      destruct (Z.ltb_spec xa xb); cbn [hits in_span]; rewrite ?Z.eqb_refl;
        destruct (covered qx y);
        destruct (Z.leb_spec xa qx), (Z.ltb_spec qx xb), (Z.leb_spec px qx), (Z.ltb_spec qx (x1 box));
        cbn [andb Z.b2z]; try reflexivity; exfalso;
        try (specialize (C eq_refl)); try (assert (false = true) by (apply C'; lia); discriminate); lia. }
    rewrite Row. replace (y + Z.of_nat (S n)) with (y + 1 + Z.of_nat n) by lia.
    apply row_by_row. lia.
Qed.
End Covers.

(** The edge-function engine, in words of [bits] bits that wrap around, hits every pixel of the
    window whose centre is inside, once. *)
Theorem edge_function_hits h bits a b c bounds px py :
  0 < h -> word_is_wide_enough h bits a b c ->
  hits (cover_in bits h a b c bounds) px py =
  Z.b2z (in_rect bounds px py && inside a b c (centre h px) (centre h py)).
Proof.
  intros Hh HW. unfold cover_in. set (r := pixel_box h a b c bounds).
  assert (InBox : forall x y, x0 r <= x < x1 r -> y0 r <= y < y1 r ->
    min3 (X a) (X b) (X c) <= centre h x <= max3 (X a) (X b) (X c) /\
    min3 (Y a) (Y b) (Y c) <= centre h y <= max3 (Y a) (Y b) (Y c)).
  { intros x y Hx Hy. rewrite <- !first_centre_le, <- !end_centre_lt by assumption.
    cbn [r pixel_box x0 x1 y0 y1] in *. lia. }
  assert (Box : in_rect bounds px py && inside a b c (centre h px) (centre h py) =
    in_rect r px py && inside a b c (centre h px) (centre h py)).
  { destruct (inside a b c (centre h px) (centre h py)) eqn:C;
      [rewrite !andb_true_r | rewrite !andb_false_r; reflexivity].
    apply inside_in_box in C as [Bx By].
    rewrite <- !first_centre_le, <- !end_centre_lt in Bx, By by assumption.
    apply eq_true_iff_eq. unfold in_rect. rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt.
    cbn [r pixel_box x0 x1 y0 y1]. lia. }
  rewrite Box. clear Box.
  destruct (Z.leb_spec (x1 r) (x0 r)); cbn [orb]; [| destruct (Z.leb_spec (y1 r) (y0 r))].
  1, 2: cbn [hits]; unfold in_rect;
    match goal with |- 0 = Z.b2z ?b => destruct b eqn:C; [exfalso | reflexivity] end;
    rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in C; clearbody r; lia.
  rewrite <- edge_cover_is_parity. unfold edge_cover.
  destruct (Z.eqb_spec (area2 a b c) 0) as [HA | HA]; [rewrite andb_false_r; reflexivity |].
  assert (Walk : forall b' c', 0 < area2 a b' c' ->
    (b' = b /\ c' = c \/ b' = c /\ c' = b) ->
    hits (walk bits (each bits right a b' c') (each bits down a b' c')
      (Z.to_nat (x1 r - x0 r)) (Z.to_nat (y1 r - y0 r)) (x0 r) (y0 r)
      (each bits (fun p q => enter h p q (x0 r) (y0 r)) a b' c')) px py =
    Z.b2z (in_rect r px py && tests a b' c' (centre h px) (centre h py))).
  { intros b' c' HP Hbc. rewrite (hits_walk h bits a b' c' r Hh (proj1 HW)); try lia.
    - unfold in_rect. rewrite Z2Nat.id by lia. replace (y0 r + (y1 r - y0 r)) with (y1 r) by lia.
      f_equal. rewrite andb_assoc. f_equal. apply andb_comm.
    - intros p q x y Hp Hq Hx Hy.
      apply (enter_fits h bits a b c); try assumption.
      + unfold corner in *. destruct Hbc as [[-> ->] | [-> ->]]; tauto.
      + unfold corner in *. destruct Hbc as [[-> ->] | [-> ->]]; tauto.
      + destruct (Z.eq_dec x (x1 r)) as [-> |]; [| destruct (InBox x y); lia].
        destruct (InBox (x1 r - 1) y); try lia. unfold centre in *; lia.
      + destruct (InBox (x0 r) y); lia. }
  destruct (Z.ltb_spec 0 (area2 a b c)); rewrite Walk; auto. rewrite area2_flip; lia.
Qed.
