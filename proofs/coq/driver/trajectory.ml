(* SPDX-License-Identifier: Apache-2.0 *)
(* The motion, step by step, from frames or from the block file of a run, each read when it is needed. *)
open Blocks

(* The breakpoints of vertex v are those from first.(v) to before first.(v + 1); x has three coordinates each. *)
type motion = { t0 : float; t1 : float; first : int array; times : float array; x : float array; hash : string Lazy.t }

(* Labels are one a cell; of a run, there are the pairs of them that have to be excluded, just these. *)
type trajectory = { dimension : int; mesh : Frames.mesh; labels : int array; excluded : (int * int) list option;
                    next : unit -> motion option }

let breakpoints_hash first times coordinates =
  let h = hash () in
  let put x = Buffer.add_int64_le h.waits (Int64.bits_of_float (x +. 0.0)) in  (* -0 becomes +0 *)
  for v = 0 to Array.length first - 2 do
    Buffer.add_int64_le h.waits (Int64.of_int (first.(v + 1) - first.(v)));
    for i = first.(v) to first.(v + 1) - 1 do
      put times.(i);
      for k = 3 * i to (3 * i) + 2 do put coordinates.(k) done
    done;
    add h ""
  done;
  digest h

let of_frames paths at_rest =
  let paths = Array.of_list paths and step = ref 0 and ahead = if at_rest then 0 else 1 in
  if Array.length paths <= ahead then reject "the command line" "expected more frames";
  let mesh, x = Frames.read_frame paths.(0) in
  let now = ref x and n = mesh.vertices in
  let next () =
    let last = !step + ahead in
    if last >= Array.length paths then None
    else begin
      let before = !now and t0 = if at_rest then 0.0 else float_of_int !step in
      if last > 0 then begin
        let found, x = Frames.read_frame paths.(last) in
        if found <> mesh then reject paths.(last) "has another mesh than the frame before";
        now := x
      end;
      let place i = (if at_rest || i mod 6 > 2 then !now else before).((i / 6 * 3) + (i mod 3)) in
      incr step;
      let first = Array.init (n + 1) (fun v -> 2 * v) and x = Array.init (6 * n) place in
      let times = Array.init (2 * n) (fun i -> t0 +. float_of_int (i land 1)) in
      Some { t0; t1 = t0 +. 1.0; first; times; x; hash = lazy (breakpoints_hash first times x) }
    end in
  { dimension = 3; mesh; labels = Array.make (Array.length mesh.cells) 0; excluded = None; next }

let read_mesh c =
  let vertices = u64 c in
  check c (vertices >= 1 && vertices <= 1 lsl 32) "an impossible number of vertices";
  let counts = many 3 u64 c in
  let vertex c = let v = u32 c in if v < vertices then v else fail c "a vertex that is not there is named" in
  let cells n size = need c n (4 * size); many n (many size vertex) c in
  let faces = cells counts.(0) 3 in
  let edges = cells counts.(1) 2 in
  let points = cells counts.(2) 1 in
  finish c;
  { Frames.vertices; cells = Array.concat [faces; edges; points] }

(* Behind HEAD: MESH, LABL, perhaps EXCL. *)
let read_scene file dimension next =
  let mesh = read_mesh (expect file "MESH") and c = expect file "LABL" in
  check c (left c = mesh.vertices) "expected a label for each vertex";
  let scripted = many mesh.vertices u8 c in
  check c (Array.for_all (fun l -> l <= 1) scripted) "a label is not 0 or 1";
  let excluded_groups, groups =
    match Blocks.next file with
    | Block b when b.kind = "EXCL" ->
      let c = body file b in
      let n = u32 c in
      check c (n > 0) "expected a pair";
      need c n 4;
      let pairs = pairs n u16 c in
      let groups = many mesh.vertices u16 c in
      finish c;
      expect_commit file;
      (pairs, groups)
    | Commit -> ([], Array.make mesh.vertices 0)
    | _ -> fail c "expected a block EXCL behind this one" in
  let label cell =
    let g = groups.(cell.(0)) in
    check c (Array.for_all (fun v -> groups.(v) = g) cell) "a cell is of two groups";
    Array.fold_left (fun s v -> s land ((2 * g) + scripted.(v))) ((2 * g) + 1) cell in
  let labels = Array.map label mesh.cells and known = Hashtbl.create 64 in
  List.iter (fun pair -> Hashtbl.replace known pair ()) excluded_groups;
  let used = List.sort_uniq compare (Array.to_list labels) in
  let is_excluded a b = a <= b && (a land b land 1 = 1 || Hashtbl.mem known (a / 2, b / 2)) in
  let with_all a = List.map (fun b -> (a, b)) (List.filter (is_excluded a) used) in
  { dimension; mesh; labels; excluded = Some (List.concat_map with_all used); next }

(* LINE: all world lines of a window. *)
let read_lines c dimension vertices t0 t1 =
  need c vertices 4;
  let first = Array.make (vertices + 1) 0 in
  Array.iteri (fun v n -> check c (n >= 2) "too few breakpoints"; first.(v + 1) <- first.(v) + n) (many vertices u32 c);
  let all = first.(vertices) in
  need c all (8 * (1 + dimension));
  let times = many all f64 c and x = Array.make (3 * all) 0.0 in
  for i = 0 to all - 1 do for k = 0 to dimension - 1 do x.((3 * i) + k) <- f64 c done done;
  finish c;
  for v = 0 to vertices - 1 do
    let i = first.(v) and last = first.(v + 1) - 1 in
    for k = i + 1 to last do check c (times.(k - 1) < times.(k)) "times do not ascend" done;
    check c (same_bits times.(i) t0 && same_bits times.(last) t1) "a world line does not begin and end with its window"
  done;
  { t0; t1; first; times; x; hash = lazy "" }

(* Each vertex begins where it was at the end of the window before. *)
let follows before now =
  let holds = ref (same_bits before.t1 now.t0) in
  for v = 0 to Array.length now.first - 2 do
    let i = 3 * (before.first.(v + 1) - 1) and j = 3 * now.first.(v) in
    for k = 0 to 2 do holds := !holds && same_bits before.x.(i + k) now.x.(j + k) done
  done;
  !holds

let of_run path =
  let file = open_file path "TRAJ" in
  let c = expect file "HEAD" in
  let dimension = u32 c in
  check c (dimension = 2 || dimension = 3) "expected dimension 2 or 3";
  check c (u32 c = 0) "the run has recorded frames alone, which are not its motion";
  check c (f64 c > 0.0) "expected a window length above 0";
  finish c;
  let run = read_scene file dimension (fun () -> None) and before = ref None and windows = ref 0 in
  let window c =
    check c (u64 c = !windows) "a window has the wrong number";
    let t = many 2 f64 c in
    finish c;
    check c (t.(0) < t.(1)) "a window ends before it begins";
    let now = read_lines (expect file "LINE") dimension run.mesh.vertices t.(0) t.(1) in
    let goes_on = match !before with Some b -> follows b now | None -> true in
    check c goes_on "a window does not go on from the one before";
    before := Some now;
    incr windows;
    ignore (expect file "VELO");
    ignore (expect file "STAT");
    expect_commit file;
    Some { now with hash = (let last = file.last in lazy last) } in
  let next () =
    match Blocks.next file with
    | End -> None
    | Block b when b.kind = "WIND" -> window (body file b)
    | _ -> refuse file "expected a block WIND before this" in
  { run with next }
