(* search edge|filter|row|plane|attribute|keys [STARTS]: the largest error found, as a share of the bound, for rows of the table of
   docs/proof.md. The operations are those of the code, in f64 and f32; the exact values are fractions. It climbs from
   random starts: a change of one number is kept where the share grows. Where each climb ends, the extracted models have
   to give the same bits. *)
module M = Search_model

let q = Q.of_float
let f32 v = Int32.float_of_bits (Int32.bits_of_float v)
let one_of list = List.nth list (Random.int (List.length list))
let between low high = low +. Random.float (high -. low)

(* Fractions of the models. *)
let to_model v =
  let { Q.num; den } = q v in
  { M.qnum = num; qden = den }

let of_model { M.qnum; qden } = Q.to_float (Q.make qnum qden)

let same what own model =
  if own <> of_model model then begin
    Printf.eprintf "search: %s is %h here and %h in the model\n" what own (of_model model);
    exit 1
  end

(* Another number near it: a few last bits, a new fraction, or something else of its size. *)
let changed v =
  match Random.int 5 with
  | 0 | 1 -> v *. (1. +. (float (Random.int 17 - 8) *. epsilon_float))
  | 2 -> v *. (1. +. between (-1e-3) 1e-3)
  | 3 -> v *. between 0.5 2.
  | _ -> Float.ldexp (between 1. 2. *. if v < 0. then -1. else 1.) (snd (Float.frexp v) - 1)

(* [share true] compares with the model, too. *)
let climb name starts steps random change share =
  let best = ref 0. in
  for _ = 1 to starts do
    let state = ref (random ()) in
    let reached = ref (share false !state) in
    for _ = 1 to steps do
      let next = change !state in
      let found = share false next in
      if found >= !reached then (state := next; reached := found)
    done;
    if !reached > 0. then ignore (share true !state);
    best := Float.max !best !reached
  done;
  Printf.printf "%s: up to %.1f%% of the bound, from %d starts of %d steps; the model has the same bits where each ends\n" name
    (100. *. !best) starts steps

let change_one numbers =
  let next = Array.copy numbers in
  let i = Random.int (Array.length next) in
  next.(i) <- changed next.(i);
  next

(* Edge::estimate of crates/core/src/raster/edge_function_exact.rs: both ends and the sample. Its box ends at the sample, so
   that the bound is the smallest that it can have. *)
let edge compare numbers =
  let ax, ay, bx, by, px, py = (numbers.(0), numbers.(1), numbers.(2), numbers.(3), numbers.(4), numbers.(5)) in
  if not (Array.for_all (fun v -> Float.abs v < 8388608.) numbers) then 0.
  else
    let dx, dy = (bx -. ax, by -. ay) in
    let estimate = (dx *. (py -. ay)) -. (dy *. (px -. ax)) in
    let reach_x, reach_y = (Float.abs (px -. ax), Float.abs (py -. ay)) in
    let bound = (5. *. (epsilon_float /. 2.) *. ((Float.abs dx *. reach_y) +. (Float.abs dy *. reach_x))) +. Float.min_float in
    if compare then begin
      let v = to_model in
      same "an edge function" estimate (M.edge_estimate (v ax) (v ay) (v bx) (v by) (v px) (v py));
      same "its bound" bound (M.edge_limit (v ax) (v ay) (v bx) (v by) (v reach_x) (v reach_y))
    end;
    let exact = Q.(((q bx - q ax) * (q py - q ay)) - ((q by - q ay) * (q px - q ax))) in
    Float.abs (Q.to_float Q.(q estimate - exact)) /. bound

let any_point_and_edge () =
  let size = Float.ldexp 1. (one_of [ 0; 3; 8; 14; 22 ]) in
  Array.init 6 (fun _ -> between (-.size) size)

(* Edge::crossing and Edge::column of crates/core/src/raster/scanline_exact.rs: ax, ay, bx, by and how far down the row is. *)
let filter compare numbers =
  let ax, ay, bx, by = (numbers.(0), numbers.(1), numbers.(2), numbers.(3)) in
  let yc = Float.floor (ay +. ((by -. ay) *. numbers.(4))) +. 0.5 in
  if not (ay <= yc && yc < by && Array.for_all (fun v -> Float.abs v < 8388608.) numbers) then 0.
  else
    let t = (yc -. ay) *. (bx -. ax) /. (by -. ay) in
    let x = ax +. t in
    let error = 6. *. epsilon_float /. 2. *. (Float.abs x +. Float.abs t +. 1.) in
    let centre = x -. 0.5 in
    let exact = Q.(q ax + ((q yc - q ay) * (q bx - q ax) / (q by - q ay)) - q 0.5) in
    if compare then begin
      let v = to_model in
      let low, high = M.row_crossing (v ax) (v ay) (v bx) (v by) (v yc) in
      same "the lowest crossing" (centre -. error) low;
      same "the highest crossing" (centre +. error) high
    end;
    let share limit = Q.to_float Q.((exact - q centre) / (q limit - q centre)) in
    Float.max (share (centre +. error)) (share (centre -. error))

let any_edge () =
  let size = Float.ldexp 1. (one_of [ 0; 3; 8; 14; 22 ]) in
  let coordinate () = between (-.size) size in
  let ay = coordinate () in
  let ax = coordinate () in
  [| ax; ay; (if Random.bool () then coordinate () else -.ax *. between 1. 3.); ay +. between 1. size; Random.float 1. |]

(* Across::depth of crates/core/src/raster/scanline/values.rs: the distance to the left edge where the width is taken, how many pixels
   farther right the depth is, the distance to the right edge there, and the heights of both edges, whole numbers. What is
   looked for is the parameter that is farthest above 1, as a share of 8 u. *)
let row compare numbers =
  let whole i low most = Z.of_float (Float.min most (Float.max low numbers.(i))) in
  let l0, r, hl, hr = (whole 0 0. 4e18, whole 1 1. 4e18, whole 2 1. 8589934591., whole 3 1. 8589934591.) in
  let pixels = Z.(whole 4 0. 8388608. * of_int 256) in
  let l, r0 = Z.(l0 + (pixels * hl), r + (pixels * hr)) in
  let v = Z.to_float in
  let slope = v hr *. (1. /. ((v l0 *. v hr) +. (v r0 *. v hl))) in
  let place = v l *. slope in
  if compare then same "a row's parameter" place (M.row_depth_place l l0 r0 hl hr);
  (* Of equal parameters the one whose last product is larger before it is rounded: a step to climb by. *)
  let before = Q.to_float Q.((q (v l) * q slope) - one) in
  (place -. 1. +. (1e-6 *. before)) /. (8. *. epsilon_float /. 2.)

let any_row () =
  let power most = Float.ldexp (between 1. 2.) (Random.int most) in
  [| power 60; one_of [ 1.; 1.; power 20 ]; power 32; power 32; one_of [ 0.; power 23 ] |]

(* Another whole number near one of them. *)
let change_whole numbers =
  let next = Array.copy numbers in
  let i = Random.int (Array.length next) in
  next.(i) <-
    (match Random.int 3 with
    | 0 -> Float.max 1. (next.(i) +. float (Random.int 65 - 32))
    | 1 -> Float.max 1. (changed next.(i))
    | _ -> Float.max 1. (Float.round (next.(i) *. between 0.999 1.001)));
  next

(* A pixel of a triangle in a window of 2^14 px, given by six coordinates in subpixels and the pixel's weights, and how
   crates/tiles/src/frames/planes.rs computes a plane through three values there: the plane with its bound, and exactly. *)
type place = { plane : bool -> float -> float -> float -> float * float; exact : (int -> Q.t) -> Q.t }

let place numbers weights =
  let whole i = Float.round numbers.(i) in
  let ax, ay, bx, by, cx, cy = (whole 0, whole 1, whole 2, whole 3, whole 4, whole 5) in
  let x1, y1 = ((bx -. ax) /. 256., (by -. ay) /. 256.) and x2, y2 = ((cx -. ax) /. 256., (cy -. ay) /. 256.) in
  let area = (x1 *. y2) -. (x2 *. y1) in
  let low a b c = Float.max 0. (Float.floor (Float.min (Float.min a b) c /. 256.)) in
  let side a b c = Float.floor (Float.max (Float.max a b) c /. 256.) +. 1. -. low a b c in
  let x0, y0, width, height = (low ax bx cx, low ay by cy, side ax bx cx, side ay by cy) in
  let wa, wb = weights in
  let mean a b c = Float.floor (((a *. wa) +. (b *. wb) +. (c *. (1. -. wa -. wb))) /. 256.) in
  let x, y = (mean ax bx cx -. x0, mean ay by cy -. y0) in
  let inside = List.for_all (fun i -> numbers.(i) >= 0. && numbers.(i) < 4194304.) [ 0; 1; 2; 3; 4; 5 ] in
  if area = 0. || not (inside && x >= 0. && y >= 0. && x < width && y < height) then None
  else
    let to_x, to_y = (x0 +. 0.5 -. (ax /. 256.), y0 +. 0.5 -. (ay /. 256.)) in
    let per_area = 1. /. area in
    let growth =
      let reach_x = Float.abs to_x +. width and reach_y = Float.abs to_y +. height in
      let reach = ((Float.abs y1 +. Float.abs y2) *. reach_x) +. ((Float.abs x1 +. Float.abs x2) *. reach_y) in
      1. +. (2. *. reach *. Float.abs per_area)
    in
    let plane compare v0 v1 v2 =
      let d1, d2 = (v1 -. v0, v2 -. v0) in
      let right = ((d1 *. y2) -. (d2 *. y1)) *. per_area and down = ((d2 *. x1) -. (d1 *. x2)) *. per_area in
      let start = f32 (v0 +. ((right *. to_x) +. (down *. to_y))) in
      let along, below = (f32 (f32 right *. x), f32 (f32 down *. y)) in
      let sum = Float.abs start +. Float.abs along +. Float.abs below in
      let size = Float.max (Float.max (Float.abs v0) (Float.abs v1)) (Float.abs v2) *. growth in
      let u32 = Float.ldexp 1. (-24) and u64 = Float.ldexp 1. (-53) in
      let value = f32 (f32 (start +. below) +. along) in
      let bound = (((4. *. u32 *. sum) +. (11. *. u64 *. size)) *. (1. +. Float.ldexp 1. (-18))) +. Float.ldexp 1. (-126) in
      if compare then begin
        let z = Z.of_float and v = to_model in
        let point x y = { M.x = z x; y = z y } in
        let frame = M.frame_of (point ax ay) (point bx by) (point cx cy) (z x0) (z y0) in
        let value', bound' = M.plane_with_bound frame (z width) (z height) (v v0) (v v1) (v v2) (v x) (v y) in
        same "a plane" value value';
        same "its bound" bound bound'
      end;
      (value, bound)
    in
    let exact v =
      let d1, d2 = Q.(v 1 - v 0, v 2 - v 0) in
      let right = Q.((d1 * q y2) - (d2 * q y1)) and down = Q.((d2 * q x1) - (d1 * q x2)) in
      Q.(v 0 + (((right * (q to_x + q x)) + (down * (q to_y + q y))) / q area))
    in
    Some { plane; exact }

(* ValuePlane::at and ValuePlane::error: six coordinates, three values, the pixel's weights. *)
let plane compare numbers =
  match place numbers (numbers.(9), numbers.(10)) with
  | None -> 0.
  | Some { plane; exact } ->
      let v i = numbers.(6 + i) in
      let value, bound = plane compare (v 0) (v 1) (v 2) in
      Float.abs (Q.to_float Q.(q value - exact (fun i -> q (v i)))) /. bound

(* Bounded::value: six coordinates, three 1/w, three attributes, and the pixel's weights. *)
let attribute compare numbers =
  let positive = List.for_all (fun i -> numbers.(i) > 1e-9 && numbers.(i) < 1e9) [ 6; 7; 8 ] in
  match place numbers (numbers.(12), numbers.(13)) with
  | Some { plane; exact } when positive ->
      let most = Float.max (Float.max numbers.(6) numbers.(7)) numbers.(8) in
      let share i = numbers.(6 + i) /. most in
      let over, en = plane compare (numbers.(9) *. share 0) (numbers.(10) *. share 1) (numbers.(11) *. share 2) in
      let under, eq = plane compare (share 0) (share 1) (share 2) in
      if under <= eq then 0.
      else
        let value = f32 (over *. f32 (1. /. under)) in
        let a = Float.abs (over /. under) in
        let bound =
          (((en +. (a *. eq)) /. (under -. eq)) +. (2. *. Float.ldexp 1. (-24) *. a)) *. (1. +. Float.ldexp 1. (-18))
          +. Float.ldexp 1. (-126)
        in
        if compare then begin
          let v = to_model in
          let value', bound' = M.quotient_with_bound (v over) (v en) (v under) (v eq) in
          same "an attribute" value value';
          same "its bound" bound bound'
        end;
        let w i = q numbers.(6 + i) in
        let under = exact w in
        if Q.sign under = 0 then 0.
        else
          let right = Q.(exact (fun i -> q numbers.(Stdlib.( + ) 9 i) * w i) / under) in
          Float.abs (Q.to_float Q.(q value - right)) /. bound
  | _ -> 0.

let any_triangle () =
  let size = one_of [ 2560.; 25600.; 256000.; 4194303. ] in
  Array.init 6 (fun _ -> Random.float size)

let any_plane () =
  Array.concat [ any_triangle (); Array.init 3 (fun _ -> between (-1.) 1.); Array.init 2 (fun _ -> between 0. 0.5) ]

let any_attribute () =
  let spread = one_of [ 1.; 3.; 100. ] in
  let some count low high = Array.init count (fun _ -> between low high) in
  Array.concat [ any_triangle (); some 3 1. spread; some 3 (-1.) 1.; some 2 0. 0.5 ]

(* Of every multiple of 2^-20, the nearest depth with another key of 24 bits: DepthFormat::key. *)
let keys () =
  let steps = 16777215. and off = 1. /. 3. /. 1048576. in
  let key depth = Float.floor ((depth *. steps) +. (0.5 +. off)) in
  let nearest = ref (infinity, 0.) in
  for i = 0 to 1048576 do
    let depth = float i /. 1048576. in
    let own = key depth in
    List.iter
      (fun side ->
        let same = ref 0. and other = ref (Float.ldexp 1. (-40)) in
        if key (depth +. (side *. !other)) <> own then begin
          for _ = 1 to 30 do
            let middle = (!same +. !other) /. 2. in
            if key (depth +. (side *. middle)) = own then same := middle else other := middle
          done;
          nearest := Stdlib.min !nearest (!other, depth +. (side *. !other))
        end)
      [ -1.; 1. ]
  done;
  let away, depth = !nearest in
  if Z.of_float (key depth) <> M.key24 (to_model depth) then (prerr_endline "search: the model has another key"; exit 1);
  Printf.printf "keys: the nearest depth with another key is 2^%.2f away; the model has the same key there\n" (Float.log2 away)

let () =
  Random.init 1;
  let starts default = if Array.length Sys.argv > 2 then int_of_string Sys.argv.(2) else default in
  let usage () = prerr_endline "usage: search edge|filter|row|plane|attribute [STARTS], or search keys"; exit 2 in
  match if Array.length Sys.argv > 3 || Array.length Sys.argv < 2 then "" else Sys.argv.(1) with
  | "edge" -> climb "filter of the edge function" (starts 1000) 4000 any_point_and_edge change_one edge
  | "filter" -> climb "filter of the scanline" (starts 1000) 4000 any_edge change_one filter
  | "row" ->
      climb "a row's parameter of depth above 1" (starts 1000) 4000 any_row change_whole row
  | "plane" -> climb "plane of a tile" (starts 1000) 4000 any_plane change_one plane
  | "attribute" -> climb "attribute of a tile" (starts 1000) 4000 any_attribute change_one attribute
  | "keys" -> keys ()
  | _ -> usage ()
