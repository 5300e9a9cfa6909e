(** Four samples a pixel (crates/render/src/pipeline/multisample.rs): a sample is the centre of a moved triangle,
    so the masks need no theorem of their own about engines. *)
From Coq Require Import ZArith Lia Bool List.
From Rasterproof Require Import Coverage Grid Scanline EdgeFunction WordWidth Mesh.
Import ListNotations.
Open Scope Z_scope.

(** In 1/16 px. *)
Definition SAMPLES : list (Z * Z) := [(6, 2); (14, 6); (2, 10); (10, 14)].

Definition onto_centre (p : point) (sample : Z * Z) : point :=
  move p (128 - fst sample * 16) (128 - snd sample * 16).

(** Centres of the moved triangle are the samples of the one that stays. *)
Theorem moved_centre_is_sample a b c sample px py :
  let to p := onto_centre p sample in
  inside (to a) (to b) (to c) (centre 128 px) (centre 128 py) =
  inside a b c (256 * px + 16 * fst sample) (256 * py + 16 * snd sample).
Proof.
  cbv zeta. unfold onto_centre.
  rewrite <- (translation a b c _ _ (128 - fst sample * 16) (128 - snd sample * 16)).
  f_equal; unfold centre; ring.
Qed.

(** The mask of one pixel: for each span that holds it, bit s is set. *)
Definition set_bit (bit : Z) (spans : list span) (px py mask : Z) : Z :=
  fold_left (fun mask s => if in_span s px py then Z.lor mask (Z.shiftl 1 bit) else mask) spans mask.

Fixpoint masks_from (cover : point -> point -> point -> rect -> list span) (a b c : point)
  (bounds : rect) (px py : Z) (samples : list (Z * Z)) (bit mask : Z) : Z :=
  match samples with
  | [] => mask
  | sample :: rest =>
      let to p := onto_centre p sample in
      masks_from cover a b c bounds px py rest (bit + 1)
        (set_bit bit (cover (to a) (to b) (to c) bounds) px py mask)
  end.

Definition masks cover a b c bounds px py := masks_from cover a b c bounds px py SAMPLES 0 0.

Lemma hits_nonneg spans px py : 0 <= hits spans px py.
Proof. induction spans as [| s spans IH]; cbn [hits]; [lia |]. destruct (in_span s px py); cbn [Z.b2z]; lia. Qed.

Lemma testbit_set_bit bit spans px py mask j : 0 <= bit ->
  Z.testbit (set_bit bit spans px py mask) j =
  Z.testbit mask j || (j =? bit) && (0 <? hits spans px py).
Proof.
  intros Hb. unfold set_bit. revert mask. induction spans as [| s spans IH]; intros mask.
  - cbn. rewrite andb_false_r, orb_false_r. reflexivity.
  - cbn [fold_left hits]. rewrite IH. pose proof (hits_nonneg spans px py).
    destruct (in_span s px py); cbn [Z.b2z].
    + rewrite Z.lor_spec, Z.shiftl_1_l, Z.pow2_bits_eqb by assumption.
      replace (0 <? 1 + hits spans px py) with true by (symmetry; apply Z.ltb_lt; lia).
      rewrite (Z.eqb_sym bit j).
      destruct (Z.testbit mask j), (j =? bit), (0 <? hits spans px py); reflexivity.
    + rewrite Z.add_0_l. reflexivity.
Qed.

Section Masks.
Variables (cover : point -> point -> point -> rect -> list span) (a b c : point) (bounds : rect).
Hypothesis cover_hits : forall sample px py, In sample SAMPLES ->
  let to p := onto_centre p sample in
  hits (cover (to a) (to b) (to c) bounds) px py =
  Z.b2z (in_rect bounds px py && inside (to a) (to b) (to c) (centre 128 px) (centre 128 py)).

(** Bit s says whether sample s is covered. *)
Lemma masks_bit s px py sample : nth_error SAMPLES s = Some sample ->
  Z.testbit (masks cover a b c bounds px py) (Z.of_nat s) =
  in_rect bounds px py && inside a b c (256 * px + 16 * fst sample) (256 * py + 16 * snd sample).
Proof.
  intros Hs. rewrite <- moved_centre_is_sample.
  pose proof (cover_hits sample px py (nth_error_In _ _ Hs)) as H. cbv zeta in *. revert H.
  set (covered := in_rect _ _ _ && _). intros H.
  assert (P : (0 <? hits (cover (onto_centre a sample) (onto_centre b sample) (onto_centre c sample)
                bounds) px py) = covered) by (rewrite H; destruct covered; reflexivity).
  unfold masks, SAMPLES in *. cbn [masks_from]. rewrite !testbit_set_bit by lia.
  destruct s as [| [| [| [| s]]]]; cbn [nth_error] in Hs; [.. | destruct s; discriminate];
    injection Hs as <-; rewrite P; cbn; rewrite ?orb_false_r; reflexivity.
Qed.
End Masks.

(** Both engines set bit s exactly where sample s lies in the triangle. *)
Theorem scanline_masks a b c bounds px py s sample : nth_error SAMPLES s = Some sample ->
  Z.testbit (masks (scanline 128) a b c bounds px py) (Z.of_nat s) =
  in_rect bounds px py && inside a b c (256 * px + 16 * fst sample) (256 * py + 16 * snd sample).
Proof. apply masks_bit. intros. apply scanline_hits. lia. Qed.

Theorem edge_function_masks a b c bounds px py s sample :
  (forall p sample, p = a \/ p = b \/ p = c -> In sample SAMPLES -> in_i32 (onto_centre p sample)) ->
  nth_error SAMPLES s = Some sample ->
  Z.testbit (masks edge_function a b c bounds px py) (Z.of_nat s) =
  in_rect bounds px py && inside a b c (256 * px + 16 * fst sample) (256 * py + 16 * snd sample).
Proof.
  intros H. apply masks_bit. intros. apply edge_function_hits; [lia |].
  apply word_width_is_enough; apply H; auto.
Qed.
