(* SPDX-License-Identifier: Apache-2.0 *)
(* The motion, step by step, from frames or from the block file of a run, each read when it is needed. *)
open Blocks

(* As in block LINE: bytes has the times of all breakpoints, from a place on, and from another their positions.
   Breakpoint first.(v) is the first of vertex v; behind them all is the number of all. A vertex becomes a list when it
   is asked for: in lists, a run takes ten times the memory. flat: all vertices have one z where the step begins, and
   one where it ends. *)
type motion = { t0 : float; t1 : float; dimension : int; first : int array; bytes : string; times : int;
                positions : int; flat : bool; hash : string Lazy.t }

(* The bits of its numbers; a third coordinate that is not there is 0. *)
let time m i = String.get_int64_le m.bytes (m.times + (8 * i))
let coordinate m i k =
  if k < m.dimension then String.get_int64_le m.bytes (m.positions + (8 * ((m.dimension * i) + k))) else 0L
let position m i = String.sub m.bytes (m.positions + (8 * m.dimension * i)) (8 * m.dimension)

(* Two vertices are at one place at all times. *)
let together m v s =
  let equal a b = Int64.float_of_bits a = Int64.float_of_bits b and i = m.first.(v) and j = m.first.(s) in
  let same n = equal (time m (i + n)) (time m (j + n))
               && List.for_all (fun k -> equal (coordinate m (i + n) k) (coordinate m (j + n) k)) [0; 1; 2] in
  let count = m.first.(v + 1) - i in
  count = m.first.(s + 1) - j && List.for_all same (List.init count Fun.id)

(* All times are multiples of 2^q, and all coordinates of 2^p. *)
let check_multiples c p q m =
  let check_from at until p =
    for i = 0 to ((until - at) / 8) - 1 do check_multiple c p (String.get_int64_le m.bytes (at + (8 * i))) done in
  let n = m.first.(Array.length m.first - 1) in
  check_from m.times (m.times + (8 * n)) q; check_from m.positions (m.positions + (8 * m.dimension * n)) p

(* Labels are one a cell; of a run, fits tells whether a list of their pairs is that of those which it excludes. more
   tells whether something follows, and does not look at it. pass skips the first steps, so many; it is called before
   next, which gives nothing if the trajectory is shorter. *)
type trajectory = { dimension : int; mesh : Frames.mesh; labels : int array; fits : (int * int) list -> bool;
                    next : unit -> motion option; more : unit -> bool; pass : int -> unit }

let hash_of m =
  let h = hash () in
  for v = 0 to Array.length m.first - 2 do
    let b = Buffer.create 80 and from = m.first.(v) and until = m.first.(v + 1) in
    let put x = Buffer.add_int64_le b (if x = Int64.min_int then 0L else x) in  (* -0 becomes +0 *)
    put (Int64.of_int (until - from));
    for i = from to until - 1 do put (time m i); List.iter (fun k -> put (coordinate m i k)) [0; 1; 2] done;
    add h (Buffer.contents b)
  done;
  digest h

(* Each vertex goes from where it is in one frame to where it is in another. *)
let between t0 t1 dimension before after =
  let n = Array.length after in let b = Buffer.create (8 * n * (2 + (2 * dimension))) in
  let put x = Buffer.add_int64_le b (Int64.bits_of_float x) in
  Array.iter (fun _ -> put t0; put t1) after;
  let place x = for k = 0 to dimension - 1 do put x.(k) done in
  Array.iter2 (fun x y -> place x; place y) before after;
  let first = Array.init (n + 1) (fun v -> 2 * v) and bytes = Buffer.contents b in
  let is_level x = Array.for_all (fun p -> p.(2) = x.(0).(2)) x in let flat = is_level before && is_level after in
  let rec m = { t0; t1; dimension; first; bytes; times = 0; positions = 16 * n; flat; hash = lazy (hash_of m) } in m

(* MESH: the number of vertices, and the cells. *)
let read_mesh c =
  let vertices = u64 c and faces, edges = both u64 c in
  let vertex c = let v = u32 c in check c (v < vertices) "a vertex that is not there is named"; v in
  let cells (n, size) = need c n (4 * size); many n (many size vertex) c in
  check c (vertices >= 1 && vertices <= 1 lsl 32) "an impossible number of vertices";
  let cells = Array.concat (List.map cells [(faces, 3); (edges, 2); (u64 c, 1)]) in
  finish c; { Frames.vertices; cells }

let rec repeat n one = if n > 0 && one () <> None then repeat (n - 1) one

(* The mesh, a function that gives the positions of the next frame, one that tells whether there is one, and one that
   skips some: of PLY and OBJ files, or of one block file of frames. *)
let frames_of_file path =
  let file = open_file path "FRMS" in
  let mesh = read_mesh (expect file "MESH") and count = ref 0 in
  ignore (expect file "CMIT");
  let positions c =
    check c (f64 c = float_of_int !count) "expected the number of the next frame"; need c mesh.vertices 24;
    let x = Array.init mesh.vertices (fun _ -> many 3 f64 c) in
    finish c; ignore (expect file "CMIT"); incr count; x in
  let next_frame () = match next file with
    | "", _ -> None
    | kind, c -> check c (kind = "FRAM") "expected a block FRAM here"; Some (positions c) in
  ({ mesh with cells = Frames.irredundant Fun.id mesh.cells }, next_frame, (fun () -> file.read < file.size),
   fun n -> repeat n next_frame)

let frames_of_paths paths =
  let mesh, x = Frames.read_frame (List.hd paths) in
  let first = ref (Some x) and rest = ref (List.tl paths) in
  let read path =
    let found, x = Frames.read_frame path in
    if found <> mesh then raise (Rejected (path ^ ": another mesh than that of the frame before"));
    rest := List.tl !rest; x in
  let next_frame () = match !first with
    | Some x -> first := None; Some x
    | None -> Option.map read (List.nth_opt !rest 0) in
  let rec pass n = if n > 0 && !rest <> [] then (rest := List.tl !rest; pass (n - 1)) in
  (mesh, next_frame, (fun () -> !first <> None || !rest <> []), pass)

let of_frames paths dimension at_rest =
  let mesh, next_frame, more_frames, pass_frames = match paths with
    | [path] when not (Frames.is_frame path) -> frames_of_file path
    | _ -> frames_of_paths paths in
  let too_few () = raise (Rejected "the command line: expected more frames") in
  let now = ref (match next_frame () with Some x -> x | None -> too_few ()) in
  if not (at_rest || more_frames ()) then too_few ();
  let pending = ref at_rest and step = ref 0.0 in
  let move x =
    let t0 = if at_rest then 0.0 else !step in
    let m = between t0 (t0 +. 1.0) dimension (if at_rest then x else !now) x in
    now := x; step := !step +. 1.0; m in
  let next () = if !pending then (pending := false; Some (move !now)) else Option.map move (next_frame ()) in
  let more () = !pending || more_frames () in
  (* The first frame was read. A step between frames begins with one. *)
  let pass n =
    if n > 0 then begin
      pass_frames (n - 1); step := float_of_int n; pending := false;
      if not at_rest then Option.iter (fun x -> now := x) (next_frame ())
    end in
  { dimension; mesh; labels = Array.map (fun _ -> 0) mesh.cells; fits = (fun _ -> true); next; more; pass }

(* Behind MESH: LABL, perhaps EXCL. The labels of the cells, and whether pairs of them are those that are excluded. *)
let read_labels file (mesh : Frames.mesh) =
  let c = expect file "LABL" in need c mesh.vertices 1;
  let scripted = many mesh.vertices u8 c in
  check c (left c = 0 && Array.for_all (fun l -> l <= 1) scripted) "expected a label for each vertex, 0 or 1";
  let kind, c = next file in
  check c (kind = "EXCL" || kind = "CMIT") "expected a block EXCL or a commit here";
  let pairs = if kind = "EXCL" then pairs u16 c else [] in
  if kind = "EXCL" then need c mesh.vertices 2;
  let groups = if kind = "EXCL" then many mesh.vertices u16 c else Array.make mesh.vertices 0 in
  if kind = "EXCL" then (check c (pairs <> [] && left c = 0) "expected pairs and groups"; ignore (expect file "CMIT"));
  let label cell =
    let g = groups.(cell.(0)) in
    check c (Array.for_all (fun v -> groups.(v) = g) cell) "a cell is of two groups";
    (2 * g) + Array.fold_left (fun s v -> s land scripted.(v)) 1 cell in
  let labels = Array.map label mesh.cells and used = Hashtbl.create 64 in
  Array.iter (fun l -> Hashtbl.replace used l ()) labels;
  (* By groups; those of two scripted cells, which may be many, are counted only. *)
  let by_groups = Hashtbl.create 64 and both_scripted (a, b) = a land b land 1 = 1 in
  let add a b =
    let pair = (min a b, max a b) in
    if Hashtbl.mem used a && Hashtbl.mem used b && not (both_scripted pair) then Hashtbl.replace by_groups pair () in
  List.iter (fun (g, h) -> List.iter (fun k -> add ((2 * g) + (k land 1)) ((2 * h) + (k lsr 1))) [0; 1; 2; 3]) pairs;
  let scripted = Hashtbl.fold (fun l () n -> n + (l land 1)) used 0 in
  let fits claimed =
    let both, others = List.partition both_scripted claimed in
    List.length both = scripted * (scripted + 1) / 2 && List.length others = Hashtbl.length by_groups
    && List.for_all (fun (a, b) -> Hashtbl.mem used a && Hashtbl.mem used b) both
    && List.for_all (Hashtbl.mem by_groups) others in
  (labels, fits)

(* LINE: all world lines of a window. *)
let read_lines c dimension vertices t0 t1 hash =
  need c vertices 4;
  let first = Array.make (vertices + 1) 0 in
  for v = 0 to vertices - 1 do first.(v + 1) <- first.(v) + u32 c done;
  let count v = first.(v + 1) - first.(v) and each part = for v = 0 to vertices - 1 do part v done in
  each (fun v -> check c (count v >= 2) "too few breakpoints");
  let times = c.at in each (fun v -> need c (count v) 8; finite_numbers c (count v));
  let m = { t0; t1; dimension; first; bytes = c.bytes; times; positions = c.at; flat = dimension = 2; hash } in
  let seconds i = Int64.float_of_bits (time m i) in
  let line v =
    let last = first.(v + 1) - 1 in
    for i = first.(v) + 1 to last do check c (seconds (i - 1) < seconds i) "times do not ascend" done;
    check c (same_bits (seconds first.(v)) t0 && same_bits (seconds last) t1) "other ends than the window's";
    finite_numbers c (dimension * count v) in
  each line; finish c; m

let of_run path =
  let file = open_file path "TRAJ" in let c = expect file "HEAD" in
  let dimension, record = both u32 c in
  check c ((dimension = 2 || dimension = 3) && record = 0 && f64 c > 0.0 && left c = 0)
    "not of dimension 2 or 3, or recorded frames alone, which are not its motion, or without a window length";
  let mesh = read_mesh (expect file "MESH") in
  let labels, fits = read_labels file mesh and windows = ref 0 and before = ref None in
  let next () = match next file with
    | "", _ -> None
    | kind, c ->
      check c (kind = "WIND" && u64 c = !windows) "expected a block WIND with the number of the next window";
      let t0, t1 = both f64 c in
      check c (t0 < t1 && left c = 0) "a window ends before it begins, or is too long";
      let c = expect file "LINE" in
      let m = read_lines c dimension mesh.vertices t0 t1 (lazy file.last) in
      (* Each vertex begins where it was at the end of the window before. *)
      let follows (t, places) =
        let goes_on = ref (same_bits t t0) in
        Array.iteri (fun v x -> goes_on := !goes_on && x = position m m.first.(v)) places; !goes_on in
      check c (Option.fold ~none:true ~some:follows !before) "a window does not go on from the one before";
      before := Some (t1, Array.init mesh.vertices (fun v -> position m (m.first.(v + 1) - 1))); incr windows;
      List.iter (fun kind -> ignore (expect file kind)) ["VELO"; "STAT"; "CMIT"];
      ignore (Lazy.force m.hash);  (* the last commit is that of this window now *)
      Some m in
  { dimension; mesh; labels; fits; next; more = (fun () -> file.read < file.size); pass = (fun n -> repeat n next) }
