(* cases T|L|I|P COUNT SEED: requests of the line protocol, ties and extremes among them; those of P are of verb I with
   smaller attributes, or with larger ones, of which planes and quotients overflow in f32. Every generated
   position is a whole number of 1/256 px but for a few that have to be snapped. *)

let pick low high = low + Random.full_int (high - low + 1)
let one_of list = List.nth list (Random.int (List.length list))
let i32 v = max (-0x8000_0000) (min 0x7fff_ffff v)
let any () = pick (-0x8000_0000) 0x7fff_ffff
let px low high = pick (low * 256) (high * 256)
let six f = List.init 6 (fun _ -> f ())
let reach () = one_of [ 1 lsl 12; 1 lsl 20; 1 lsl 24; 1 lsl 30 ]

(* Six coordinates, x and y by turns, in subpixels. *)
let triangle () =
  match Random.int 9 with
  | 0 -> six (fun () -> px (-2) 18)
  | 1 -> six (fun () -> 128 * pick (-4) 36) (* half pixels: ties *)
  | 2 -> six (fun () -> (256 * pick (-2) 17) + 128) (* corners on centres *)
  | 3 -> six (fun () -> (256 * pick (-2) 17) + 128 + pick (-1) 1) (* near ties *)
  | 4 ->
      (* no area *)
      let x = px (-2) 18 and y = px (-2) 18 and dx = pick (-300) 300 and dy = pick (-300) 300 in
      List.concat (List.init 3 (fun _ -> let k = pick (-8) 8 in [ x + (k * dx); y + (k * dy) ]))
  | 5 ->
      (* slivers *)
      let ax = px (-2) 18 and ay = px (-2) 18 and bx = px (-2) 18 and by = px (-2) 18 in
      let t = pick 0 100 and near () = pick (-2) 2 in
      let between a b = a + ((b - a) * t / 100) + near () in
      [ ax; ay; bx; by; between ax bx; between ay by ]
  | 6 -> six any
  | 7 ->
      (* huge, through the window *)
      let s = reach () and x = px 0 16 and y = px 0 16 in
      let dx = pick (-s) s and dy = pick (-s) s in
      [ x + dx; y + dy; x - dx; y - dy; x + pick (-s) s; y + pick (-s) s ]
  | _ ->
      let x = (256 * pick 0 15) + 128 and y = (256 * pick 0 15) + 128 in
      List.concat (List.init 3 (fun _ -> [ x + pick (-40) 40; y + pick (-40) 40 ]))

(* Four coordinates in pixels. *)
let segment () =
  let x = pick (-4) 24 and y = pick (-4) 24 in
  let line =
    match Random.int 6 with
    | 0 -> List.init 4 (fun _ -> pick (-8) 32)
    | 1 ->
        (* an even length: ties *)
        let n = 2 * pick 0 16 in
        let r = pick (-n) n in
        let dx, dy = one_of [ (n, r); (-n, r); (r, n); (r, -n) ] in
        [ x; y; x + dx; y + dy ]
    | 2 -> [ x; y; x + one_of [ 0; 0; 9; -9; 1; -1 ]; y + one_of [ 0; 0; 9; -9; 1 ] ]
    | 3 -> List.init 4 (fun _ -> any () asr 8)
    | 4 ->
        let s = one_of [ 100; 1 lsl 10; 1 lsl 20; 1 lsl 22 ] in
        let dx = pick (-s) s and dy = pick (-s) s in
        [ x - dx; y - dy; x + dx; y + dy ]
    | _ ->
        let s = one_of [ 50; 1 lsl 16; 1 lsl 22 ] in
        [ x; y; x + pick (-s) s; y + pick (-s) s ]
  in
  match line with
  | [ ax; ay; bx; by ] when Random.bool () -> [ bx; by; ax; ay ]
  | line -> line

let shuffled corners =
  let keyed = List.map (fun corner -> (Random.bits (), corner)) corners in
  List.map snd (List.sort compare keyed)

let rec pairs = function x :: y :: rest -> (x, y) :: pairs rest | _ -> []

(* Depth, w and two attributes of three corners: like each other, far apart, equal, tiny and large, which half of them are where that is
   asked for. *)
let values ?(often = false) large =
  let power low high = Float.ldexp (1. +. Random.float 1.) (pick low high) in
  let w = one_of [ (0, 0); (0, 3); (-4, 20); (-199, 198) ] and same_w = Random.int 8 = 0 in
  let first_w = power (fst w) (snd w) in
  let value () =
    match if often && Random.bool () then 3 else Random.int 6 with
    | 0 -> 0.
    | 1 -> float (pick (-9) 9)
    | 2 -> power (-1074) (-1000)
    | 3 -> -.power (fst large) (snd large)
    | _ -> Random.float 2. -. 1.
  in
  let near = value () in
  let attribute () = if Random.int 4 = 0 then near else value () in
  List.init 3 (fun _ ->
      [ Random.float 2. -. 1.; (if same_w then first_w else power (fst w) (snd w)); attribute (); attribute () ])

let () =
  match Sys.argv with
  | [| _; verb; count; seed |] ->
      Random.init (int_of_string seed);
      for id = 1 to int_of_string count do
        let subpixels =
          if verb <> "L" then triangle ()
          else List.map (fun v -> (v * 256) + if Random.bool () then 0 else pick 0 255) (segment ())
        in
        let corners = pairs subpixels in
        let corners = if verb <> "L" then shuffled corners else corners in
        let off = Random.int 27 = 0 in
        let word v = Printf.sprintf "%.17g" (float (i32 v) /. 256. +. if off then Random.float 3e-3 else 0.) in
        let more =
          let print = List.map (List.map (Printf.sprintf "%.17g")) in
          match verb with
          | "I" -> print (values (480, 498))
          | "P" -> print (if Random.int 3 = 0 then values ~often:true (118, 145) else values (20, 40))
          | _ -> List.map (fun _ -> []) corners
        in
        let words = List.concat (List.map2 (fun (x, y) more -> word x :: word y :: more) corners more) in
        let sides = [ pick 1 24; pick 1 24 ] |> List.map string_of_int in
        print_endline (String.concat " " (((if verb = "P" then "I" else verb) :: string_of_int id :: sides) @ words))
      done
  | _ ->
      prerr_endline "usage: cases T|L|I|P COUNT SEED";
      exit 2
