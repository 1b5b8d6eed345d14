(* SPDX-License-Identifier: Apache-2.0 *)
(* The motion, step by step, from frames or from the block file of a run. *)
open Input

(* The breakpoints of vertex v are those from first.(v) to before first.(v + 1). *)
type motion = { t0 : float; t1 : float; first : int array; times : float array; x : float array }

(* What does not change: labels one a cell; for a run, the pairs of labels that have to be excluded, just these. *)
type scene = { dimension : int; mesh : Frames.mesh; labels : int array; excluded : (int * int) list option }

type trajectory = { scene : scene; next : unit -> motion option }

let hash m =
  let s = sink () in
  for v = 0 to Array.length m.first - 2 do
    put_u64 s (m.first.(v + 1) - m.first.(v));
    for i = m.first.(v) to m.first.(v + 1) - 1 do
      put_f64 s m.times.(i);
      for k = 3 * i to (3 * i) + 2 do put_f64 s m.x.(k) done
    done
  done;
  sink_digest s

(* Frames, each read when it is needed. *)
let of_frames paths at_rest =
  let paths = Array.of_list paths and step = ref 0 in
  if Array.length paths < (if at_rest then 1 else 2) then reject "the command line" "expected more frames";
  let now = ref (Frames.read_frame paths.(0)) in
  let mesh = !now.mesh in
  let read i =
    let frame = Frames.read_frame paths.(i) in
    if frame.mesh <> mesh then reject paths.(i) "has another mesh than the frame before";
    now := { frame with mesh } in
  let next () =
    let k = !step in
    let last = if at_rest then k else k + 1 in
    if last >= Array.length paths then None
    else begin
      let before = !now.x in
      if last > 0 then read last;
      let after = !now.x and t0 = if at_rest then 0.0 else float_of_int k in
      let before = if at_rest then after else before in
      let place i = let frame = if i / 3 land 1 = 0 then before else after in frame.((i / 6 * 3) + (i mod 3)) in
      incr step;
      Some { t0; t1 = t0 +. 1.0; first = Array.init (mesh.vertices + 1) (fun v -> 2 * v);
             times = Array.init (2 * mesh.vertices) (fun i -> if i land 1 = 0 then t0 else t0 +. 1.0);
             x = Array.init (6 * mesh.vertices) place }
    end in
  { scene = { dimension = 3; mesh; labels = Array.make (Array.length mesh.cells) 0; excluded = None }; next }

(* The first group of a run: HEAD, MESH, LABL, perhaps EXCL. *)

let read_mesh c =
  let vertices = u64 c in
  if vertices < 1 || vertices > 1 lsl 32 then fail c "an impossible number of vertices";
  let faces = u64 c in
  let edges = u64 c in
  let points = u64 c in
  let vertex _ = let v = u32 c in if v >= vertices then fail c "a vertex that is not there is named" else v in
  let cells n size = need c n (4 * size); Array.init n (fun _ -> Array.init size vertex) in
  let faces = cells faces 3 in
  let edges = cells edges 2 in
  let points = cells points 1 in
  finish c;
  { Frames.vertices; cells = Array.concat [faces; edges; points] }

(* The excluded pairs of groups, and the group of each vertex. *)
let read_exclusions c vertices =
  let n = u32 c and before = ref (-1) and pairs = Hashtbl.create 64 in
  need c n 4;
  for _ = 1 to n do
    let a = u16 c in
    let b = u16 c in
    let pair = (a lsl 16) lor b in
    if a > b || pair <= !before then fail c "pairs are not in order";
    before := pair;
    Hashtbl.add pairs (a, b) ()
  done;
  if n = 0 then fail c "expected a pair";
  let groups = Array.init vertices (fun _ -> u16 c) in
  finish c;
  (pairs, groups)

let read_scene file =
  let c = Blocks.expect file "HEAD" in
  let dimension = u32 c in
  if dimension <> 2 && dimension <> 3 then fail c "expected dimension 2 or 3";
  if u32 c <> 0 then fail c "the run has recorded frames alone, which are not its motion";
  if not (f64 c > 0.0) then fail c "expected a window length above 0";
  finish c;
  let mesh = read_mesh (Blocks.expect file "MESH") in
  let c = Blocks.expect file "LABL" in
  if left c <> mesh.vertices then fail c "expected a label for each vertex";
  let scripted = Array.init mesh.vertices (fun _ -> let l = u8 c in if l > 1 then fail c "a label is not 0 or 1" else l) in
  let pairs, groups =
    match Blocks.next file with
    | Block b when b.kind = "EXCL" ->
      let found = read_exclusions (Blocks.body file b) mesh.vertices in
      Blocks.expect_commit file;
      found
    | Commit -> (Hashtbl.create 1, Array.make mesh.vertices 0)
    | _ -> fail c "expected a block EXCL behind this one" in
  let label cell =
    let g = groups.(cell.(0)) in
    if Array.exists (fun v -> groups.(v) <> g) cell then fail c "a cell is of two groups";
    (2 * g) + Array.fold_left (fun s v -> min s scripted.(v)) 1 cell in
  let labels = Array.map label mesh.cells in
  let used = List.sort_uniq compare (Array.to_list labels) in
  let is_excluded a b = a <= b && ((a land b land 1 = 1) || Hashtbl.mem pairs (a / 2, b / 2)) in
  let excluded = List.concat_map (fun a -> List.filter_map (fun b -> if is_excluded a b then Some (a, b) else None) used) used in
  { dimension; mesh; labels; excluded = Some excluded }

(* LINE: all world lines of a window. *)
let read_lines c dimension vertices t0 t1 =
  let first = Array.make (vertices + 1) 0 in
  need c vertices 4;
  for v = 0 to vertices - 1 do
    let n = u32 c in
    if n < 2 then fail c "a vertex has fewer than two breakpoints";
    first.(v + 1) <- first.(v) + n
  done;
  let all = first.(vertices) in
  need c all (8 * (1 + dimension));
  let times = Array.make all 0.0 and x = Array.make (3 * all) 0.0 in
  for i = 0 to all - 1 do times.(i) <- f64 c done;
  for i = 0 to all - 1 do for k = 0 to dimension - 1 do x.((3 * i) + k) <- f64 c done done;
  finish c;
  for v = 0 to vertices - 1 do
    for i = first.(v) + 1 to first.(v + 1) - 1 do
      if not (times.(i - 1) < times.(i)) then fail c "times do not ascend"
    done;
    if not (same_bits times.(first.(v)) t0 && same_bits times.(first.(v + 1) - 1) t1) then
      fail c "a world line does not begin and end with its window"
  done;
  { t0; t1; first; times; x }

(* Each vertex begins where it was at the end of the window before. *)
let follows before now =
  let goes_on v =
    let i = 3 * (before.first.(v + 1) - 1) and j = 3 * now.first.(v) in
    same_bits before.x.(i) now.x.(j) && same_bits before.x.(i + 1) now.x.(j + 1)
    && same_bits before.x.(i + 2) now.x.(j + 2) in
  let rec all v = v < 0 || (goes_on v && all (v - 1)) in
  same_bits before.t1 now.t0 && all (Array.length now.first - 2)

let of_run path =
  let file = Blocks.open_file path "TRAJ" in
  let scene = read_scene file and before = ref None and windows = ref 0 in
  let window c =
    if u64 c <> !windows then fail c "a window has the wrong number";
    let t0 = f64 c in
    let t1 = f64 c in
    finish c;
    if not (t0 < t1) then fail c "a window ends before it begins";
    let now = read_lines (Blocks.expect file "LINE") scene.dimension scene.mesh.vertices t0 t1 in
    (match !before with
     | Some b when not (follows b now) -> fail c "a window does not begin where the one before ends"
     | _ -> before := Some now);
    incr windows;
    ignore (Blocks.expect file "VELO");
    ignore (Blocks.expect file "STAT");
    Blocks.expect_commit file;
    Some now in
  let next () =
    match Blocks.next file with
    | End -> None
    | Block b when b.kind = "WIND" -> window (Blocks.body file b)
    | _ -> Blocks.refuse file file.at "expected a block WIND before this" in
  { scene; next }
