(* search filter|attribute|keys [STARTS]: the largest error found, as a share of the bound, for rows of the table of docs/proof.md.
   The operations are those of the code, in f64 and f32; the exact values are fractions. It climbs from random starts: a
   change of one number is kept where the share grows. *)

let q = Q.of_float
let f32 v = Int32.float_of_bits (Int32.bits_of_float v)
let one_of list = List.nth list (Random.int (List.length list))
let between low high = low +. Random.float (high -. low)

(* Another number near it: a few last bits, a new fraction, or something else of its size. *)
let changed v =
  match Random.int 5 with
  | 0 | 1 -> v *. (1. +. (float (Random.int 17 - 8) *. epsilon_float))
  | 2 -> v *. (1. +. between (-1e-3) 1e-3)
  | 3 -> v *. between 0.5 2.
  | _ -> Float.ldexp (between 1. 2. *. if v < 0. then -1. else 1.) (snd (Float.frexp v) - 1)

let climb name starts steps random change share =
  let best = ref 0. in
  for _ = 1 to starts do
    let state = ref (random ()) in
    let reached = ref (share !state) in
    for _ = 1 to steps do
      let next = change !state in
      let found = share next in
      if found >= !reached then (state := next; reached := found)
    done;
    best := Float.max !best !reached
  done;
  Printf.printf "%s: up to %.1f%% of the bound, from %d starts of %d steps\n" name (100. *. !best) starts steps

let change_one numbers =
  let next = Array.copy numbers in
  let i = Random.int (Array.length next) in
  next.(i) <- changed next.(i);
  next

(* Edge::crossing and Edge::column of crates/core/src/raster/scanline_exact.rs: ax, ay, bx, by and how far down the row is. *)
let filter factor numbers =
  let ax, ay, bx, by = (numbers.(0), numbers.(1), numbers.(2), numbers.(3)) in
  let yc = Float.floor (ay +. ((by -. ay) *. numbers.(4))) +. 0.5 in
  if not (ay <= yc && yc < by && Array.for_all (fun v -> Float.abs v < 8388608.) numbers) then 0.
  else
    let t = (yc -. ay) *. (bx -. ax) /. (by -. ay) in
    let x = ax +. t in
    let error = factor *. epsilon_float /. 2. *. (Float.abs x +. Float.abs t +. 1.) in
    let centre = x -. 0.5 in
    let exact = Q.(q ax + ((q yc - q ay) * (q bx - q ax) / (q by - q ay)) - q 0.5) in
    let share limit = Q.to_float Q.((exact - q centre) / (q limit - q centre)) in
    Float.max (share (centre +. error)) (share (centre -. error))

let any_edge () =
  let size = Float.ldexp 1. (one_of [ 0; 3; 8; 14; 22 ]) in
  let coordinate () = between (-.size) size in
  let ay = coordinate () in
  let ax = coordinate () in
  [| ax; ay; (if Random.bool () then coordinate () else -.ax *. between 1. 3.); ay +. between 1. size; Random.float 1. |]

(* Bounded::value of crates/tiles/src/frames/planes.rs, for a triangle in a window of 2^14 px: six coordinates, three 1/w,
   three attributes, and the pixel's weights. *)
let attribute numbers =
  let whole i = Float.round numbers.(i) in
  let ax, ay, bx, by, cx, cy = (whole 0, whole 1, whole 2, whole 3, whole 4, whole 5) in
  let x1, y1 = ((bx -. ax) /. 256., (by -. ay) /. 256.) and x2, y2 = ((cx -. ax) /. 256., (cy -. ay) /. 256.) in
  let area = (x1 *. y2) -. (x2 *. y1) in
  let low a b c = Float.max 0. (Float.floor (Float.min (Float.min a b) c /. 256.)) in
  let side a b c = Float.floor (Float.max (Float.max a b) c /. 256.) +. 1. -. low a b c in
  let x0, y0, width, height = (low ax bx cx, low ay by cy, side ax bx cx, side ay by cy) in
  let mean a b c = Float.floor (((a *. numbers.(12)) +. (b *. numbers.(13)) +. (c *. (1. -. numbers.(12) -. numbers.(13)))) /. 256.) in
  let x, y = (mean ax bx cx -. x0, mean ay by cy -. y0) in
  let inside = List.for_all (fun i -> numbers.(i) >= 0. && numbers.(i) < 4194304.) [ 0; 1; 2; 3; 4; 5 ] in
  let positive = List.for_all (fun i -> numbers.(i) > 1e-9 && numbers.(i) < 1e9) [ 6; 7; 8 ] in
  if area = 0. || not (inside && positive && x >= 0. && y >= 0. && x < width && y < height) then 0.
  else
    let to_x, to_y = (x0 +. 0.5 -. (ax /. 256.), y0 +. 0.5 -. (ay /. 256.)) in
    let per_area = 1. /. area in
    let growth =
      let reach_x = Float.abs to_x +. width and reach_y = Float.abs to_y +. height in
      let reach = ((Float.abs y1 +. Float.abs y2) *. reach_x) +. ((Float.abs x1 +. Float.abs x2) *. reach_y) in
      1. +. (2. *. reach *. Float.abs per_area)
    in
    let plane v0 v1 v2 =
      let d1, d2 = (v1 -. v0, v2 -. v0) in
      let right = ((d1 *. y2) -. (d2 *. y1)) *. per_area and down = ((d2 *. x1) -. (d1 *. x2)) *. per_area in
      let start = f32 (v0 +. ((right *. to_x) +. (down *. to_y))) in
      let along, below = (f32 (f32 right *. x), f32 (f32 down *. y)) in
      let sum = Float.abs start +. Float.abs along +. Float.abs below in
      let size = Float.max (Float.max (Float.abs v0) (Float.abs v1)) (Float.abs v2) *. growth in
      let u32 = Float.ldexp 1. (-24) and u64 = Float.ldexp 1. (-53) in
      ( f32 (f32 (start +. below) +. along),
        (((4. *. u32 *. sum) +. (11. *. u64 *. size)) *. (1. +. Float.ldexp 1. (-18))) +. Float.ldexp 1. (-126) )
    in
    let most = Float.max (Float.max numbers.(6) numbers.(7)) numbers.(8) in
    let share i = numbers.(6 + i) /. most in
    let over, en = plane (numbers.(9) *. share 0) (numbers.(10) *. share 1) (numbers.(11) *. share 2) in
    let under, eq = plane (share 0) (share 1) (share 2) in
    if under <= eq then 0.
    else
      let value = f32 (over *. f32 (1. /. under)) in
      let a = Float.abs (over /. under) in
      let bound =
        (((en +. (a *. eq)) /. (under -. eq)) +. (2. *. Float.ldexp 1. (-24) *. a)) *. (1. +. Float.ldexp 1. (-18))
        +. Float.ldexp 1. (-126)
      in
      let exact v =
        let value i = v i in
        let d1, d2 = Q.(value 1 - value 0, value 2 - value 0) in
        let right = Q.((d1 * q y2) - (d2 * q y1)) and down = Q.((d2 * q x1) - (d1 * q x2)) in
        Q.((value 0 * q area) + (right * (q to_x + q x)) + (down * (q to_y + q y)))
      in
      let w i = q numbers.(6 + i) in
      let under = exact w in
      if Q.sign under = 0 then 0.
      else
        let right = Q.(exact (fun i -> q numbers.(Stdlib.( + ) 9 i) * w i) / under) in
        Float.abs (Q.to_float Q.(q value - right)) /. bound

let any_triangle () =
  let size = one_of [ 2560.; 25600.; 256000.; 4194303. ] in
  let corner () = Random.float size in
  let spread = one_of [ 1.; 3.; 100. ] in
  Array.init 14 (fun i ->
      if i < 6 then corner () else if i < 9 then between 1. spread else if i < 12 then between (-1.) 1. else between 0. 0.5)

(* Of every multiple of 2^-20, the nearest depth with another key of 24 bits: DepthFormat::key. *)
let keys () =
  let steps = 16777215. and off = 1. /. 3. /. 1048576. in
  let key depth = Float.floor ((depth *. steps) +. (0.5 +. off)) in
  let nearest = ref infinity in
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
          nearest := Float.min !nearest !other
        end)
      [ -1.; 1. ]
  done;
  Printf.printf "keys: the nearest depth with another key is 2^%.2f away\n" (Float.log2 !nearest)

let () =
  Random.init 1;
  let starts default = if Array.length Sys.argv > 2 then int_of_string Sys.argv.(2) else default in
  match Sys.argv with
  | [| _; "filter" |] | [| _; "filter"; _ |] -> climb "filter of the scanline" (starts 1000) 4000 any_edge change_one (filter 6.)
  | [| _; "attribute" |] | [| _; "attribute"; _ |] ->
      climb "attribute of a tile" (starts 1000) 4000 any_triangle change_one attribute
  | [| _; "keys" |] -> keys ()
  | _ -> prerr_endline "usage: search filter|attribute [STARTS], or search keys"; exit 2
