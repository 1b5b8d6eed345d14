(* SPDX-License-Identifier: Apache-2.0 *)
(* The motion, step by step, from frames or from the block file of a run, each read when it is needed. *)
open Blocks

(* By vertex its breakpoints, time and place. *)
type motion = { t0 : float; t1 : float; lines : (float * float array) array array; hash : string Lazy.t }

(* Labels are one a cell; of a run, fits tells whether a list of their pairs is that of those which it excludes. *)
type trajectory = { dimension : int; mesh : Frames.mesh; labels : int array; fits : (int * int) list -> bool;
                    next : unit -> motion option }

let hash_of lines =
  let h = hash () and put b x = Buffer.add_int64_le b (Int64.bits_of_float (x +. 0.0)) in  (* -0 becomes +0 *)
  let line l =
    let b = Buffer.create 80 in Buffer.add_string b (text 8 (Array.length l));
    Array.iter (fun (t, x) -> put b t; Array.iter (put b) x) l;
    add h (Buffer.contents b) in
  Array.iter line lines; digest h

let of_frames paths at_rest =
  let mesh, x = Frames.read_frame (List.hd paths) in
  let rest = ref (if at_rest then paths else List.tl paths) and now = ref x and step = ref 0.0 in
  if !rest = [] then raise (Rejected "the command line: expected more frames");
  let read path =
    let found, x = Frames.read_frame path in
    if found <> mesh then raise (Rejected (path ^ ": another mesh than that of the frame before"));
    let t0 = if at_rest then 0.0 else !step in let t1 = t0 +. 1.0 in
    let lines = Array.map2 (fun a b -> [| (t0, a); (t1, b) |]) (if at_rest then x else !now) x in
    rest := List.tl !rest; now := x; step := !step +. 1.0;
    { t0; t1; lines; hash = lazy (hash_of lines) } in
  let next () = Option.map read (List.nth_opt !rest 0) in
  { dimension = 3; mesh; labels = Array.map (fun _ -> 0) mesh.cells; fits = (fun _ -> true); next }

let read_mesh c =
  let vertices = u64 c and faces, edges = both u64 c in
  let vertex c = let v = u32 c in check c (v < vertices) "a vertex that is not there is named"; v in
  let cells (n, size) = need c n (4 * size); many n (many size vertex) c in
  check c (vertices >= 1 && vertices <= 1 lsl 32) "an impossible number of vertices";
  let cells = Array.concat (List.map cells [(faces, 3); (edges, 2); (u64 c, 1)]) in
  finish c; { Frames.vertices; cells }

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
let read_lines c dimension vertices t0 t1 =
  need c vertices 4;
  let counts = many vertices u32 c in
  check c (Array.for_all (fun n -> n >= 2) counts) "too few breakpoints";
  let times = Array.map (fun n -> need c n 8; many n f64 c) counts in
  let place _ = Array.init 3 (fun k -> if k < dimension then f64 c else 0.0) in
  let line times =
    Array.iteri (fun i t -> check c (i = 0 || times.(i - 1) < t) "times do not ascend") times;
    check c (same_bits times.(0) t0 && same_bits times.(Array.length times - 1) t1) "other ends than the window's";
    Array.map (fun t -> (t, place t)) times in
  let lines = Array.map line times in finish c;
  lines

let of_run path =
  let file = open_file path "TRAJ" in let c = expect file "HEAD" in
  let dimension, record = both u32 c in
  check c ((dimension = 2 || dimension = 3) && record = 0 && f64 c > 0.0 && left c = 0)
    "not of dimension 2 or 3, or recorded frames alone, which are not its motion, or without a window length";
  let mesh = read_mesh (expect file "MESH") in
  let labels, fits = read_labels file mesh and windows = ref 0 and before = ref None in
  (* Each vertex begins where it was at the end of the window before. *)
  let follows old line =
    let t, x = old.(Array.length old - 1) and u, y = line.(0) in same_bits t u && Array.for_all2 same_bits x y in
  let next () = match next file with
    | "", _ -> None
    | kind, c ->
      check c (kind = "WIND" && u64 c = !windows) "expected a block WIND with the number of the next window";
      let t0, t1 = both f64 c in
      check c (t0 < t1 && left c = 0) "a window ends before it begins, or is too long";
      let lines = read_lines (expect file "LINE") dimension mesh.vertices t0 t1 in
      let goes_on = match !before with Some old -> Array.for_all2 follows old lines | None -> true in
      check c goes_on "a window does not go on from the one before"; before := Some lines; incr windows;
      List.iter (fun kind -> ignore (expect file kind)) ["VELO"; "STAT"; "CMIT"];
      Some { t0; t1; lines; hash = Lazy.from_val file.last } in
  { dimension; mesh; labels; fits; next }
