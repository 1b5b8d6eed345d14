(* SPDX-License-Identifier: Apache-2.0 *)
(* noli_check_verified PROOF FRAME... | noli_check_verified PROOF TRAJECTORY
   Checks a proof that nothing touches, or that something does (proofs/FORMAT.md); for its exit codes see section 6.

   What this does: it reads the files, compares hashes, and turns numbers into integers. Whether a token may be used
   and a witness holds, the functions decide that are extracted from Coq: Checker.start, Checker.step, Hit.check_hit.
   What it does not do: it finds nothing by itself, and shares nothing with the other checker but the document. *)
open Blocks
open Trajectory

type claim = {
  source : int; dimension : int; points : bool;
  strict : bool; ring : int; eta : float; labels : int array; excluded : (int * int) list;
  same : int array;         (* by vertex: the one that stands for it *)
  cells : int array array;  (* before merging *)
}

let read_merged c vertices is_run =
  let same = Array.init vertices Fun.id and n = u32 c and before = ref (-1) in
  need c n 8;
  check c (n = 0 || not is_run) "a run has no merged vertices";
  for _ = 1 to n do
    let p = many 2 u32 c in
    let v = p.(0) and s = p.(1) in
    check c (v > !before && v < vertices && s < v && same.(s) = s) "merged vertices are not in order";
    same.(v) <- s;
    before := v
  done;
  same

(* The cells of frames without those that are redundant after merging. *)
let cells_of (mesh : Frames.mesh) same points =
  let used = Array.make mesh.vertices (not points) and all = Array.to_list mesh.cells in
  List.iter (Array.iter (fun v -> used.(v) <- true)) all;
  let unused = List.filter (fun c -> not used.(c.(0))) (List.init mesh.vertices (fun v -> [| v |])) in
  let of_size n = List.filter (fun c -> Array.length c = n) all in
  let points = List.rev_append (List.rev (of_size 1)) unused in
  Frames.irredundant mesh.vertices (fun v -> same.(v)) (of_size 3, of_size 2, points)

let cells_hash claim =
  let h = hash () in
  let u32 n = Buffer.add_int32_le h.waits (Int32.of_int n) and u64 n = Buffer.add_int64_le h.waits (Int64.of_int n) in
  let cell i c =
    Buffer.add_uint8 h.waits (Array.length c);
    Array.iter (fun v -> u32 claim.same.(v)) c;
    u32 claim.labels.(i);
    add h "" in
  u64 (Array.length claim.same);
  u64 (Array.length claim.cells);
  Array.iteri cell claim.cells;
  digest h

(* CLAM: the claim, and the steps that it is about. *)
let read_claim file paths =
  let c = expect file "CLAM" in
  let fields = many 4 u8 c in
  let source = fields.(0) and dimension = fields.(1) and flags = fields.(2) in
  let is_run = source = 2 in
  check c (source <= 2 && (dimension = 2 || dimension = 3) && flags <= (if is_run then 1 else 3) && fields.(3) = 0)
    "a field of the claim has an impossible value";
  let ring = u32 c in
  let eta = f64 c in
  check c (not (Float.sign_bit eta) && ring >= 1 && (eta > 0.0 || ring = 1)) "an impossible distance or ring";
  let hash = take c 32 in
  check c (not is_run || List.length paths = 1) "the proof is of a run: expected its trajectory.blocks, one file";
  let trajectory = if is_run then of_run (List.hd paths) else of_frames paths (source = 1) in
  let mesh = trajectory.mesh in
  check c (not is_run || dimension = trajectory.dimension) "the run has another dimension";
  let same = read_merged c mesh.vertices is_run in
  let n = u32 c in
  need c n 8;
  let excluded = pairs n u32 c in
  finish c;
  let right = Option.value trajectory.excluded ~default:excluded in
  check c (excluded = right) "other pairs are excluded than those of the run";
  let cells = if is_run then mesh.cells else cells_of mesh same (flags >= 2) in
  let labels = if is_run then trajectory.labels else Array.make (Array.length cells) 0 in
  let claim = { source; dimension; points = flags >= 2; strict = flags land 1 = 1; ring; eta; same; cells; labels; excluded } in
  check c (cells <> [||]) "a claim about no cells";
  check c (cells_hash claim = hash) "the claim is about other cells than those of the trajectory";
  expect_commit file;
  let flat m = if dimension = 2 then Array.iteri (fun i _ -> if i mod 3 = 2 then m.x.(i) <- 0.0) m.x; m in
  (claim, fun () -> Option.map flat (trajectory.next ()))

(* Merged vertices are at one place at all times. *)
let require_merged c claim m =
  let compare_places v s =
    for k = 0 to if v = s then -1 else (3 * (m.first.(v + 1) - m.first.(v))) - 1 do
      check c (m.x.((3 * m.first.(v)) + k) = m.x.((3 * m.first.(s)) + k)) "merged vertices are not at one place"
    done in
  Array.iteri compare_places claim.same

(* The claim about a step, in integers. Paths are made when they are asked for. *)
let scene_of c claim m p q ring cell : Spec.scene =
  let all = Array.for_all in
  check c (all (is_multiple p) [| claim.eta |] && all (is_multiple q) m.times && all (is_multiple p) m.x)
    "a number of the motion is no multiple of the step's unit";
  let known = Array.make (Array.length claim.same) [] in
  let rec breakpoints i first acc =
    let x k = integer p m.x.((3 * i) + k) in
    if i < first then acc
    else breakpoints (i - 1) first ((integer q m.times.(i), { Spec.vx = x 0; vy = x 1; vz = x 2 }) :: acc) in
  let path v =
    (match known.(v) with [] -> known.(v) <- breakpoints (m.first.(v + 1) - 1) m.first.(v) [] | _ -> ());
    known.(v) in
  { tbeg = integer q m.t0; tend = integer q m.t1; path = (fun v -> path (Z.to_int v));
    same = (fun v -> Z.of_int claim.same.(Z.to_int v)); ncell = Z.of_int (Array.length claim.cells);
    cell = (fun i -> List.map Z.of_int (Array.to_list (cell claim.cells.(Z.to_int i))));
    label = (fun i -> Z.of_int claim.labels.(Z.to_int i)); eta = integer p claim.eta; ring = Z.of_int ring;
    excluded = List.rev (List.rev_map (fun (a, b) -> (Z.of_int a, Z.of_int b)) claim.excluded) }

let rec read_tree c cells depth =
  let code = uint c in
  check c (code <= cells && (code > 0 || depth < 255)) "the tree is too deep, or has a cell that is not there";
  if code > 0 then Checker.Cell (Z.of_int (code - 1))
  else
    let left = read_tree c cells (depth + 1) in
    Checker.Join (left, read_tree c cells (depth + 1))

let vector c s =
  let x = Array.map (fun m -> Z.shift_left m s) (many 3 sint c) in
  { Spec.vx = x.(0); vy = x.(1); vz = x.(2) }

let direction x y z = Checker.TDirection { vx = Z.of_int x; vy = Z.of_int y; vz = Z.of_int z }

let token c =
  match u8 c with
  | 0x00 -> Checker.THalve | 0x01 -> TLeft | 0x02 -> TRight | 0x03 -> TParts | 0x04 -> TOne | 0x05 -> TBoth
  | 0x06 -> TExcluded | 0x08 -> direction 1 0 0 | 0x09 -> direction (-1) 0 0 | 0x0a -> direction 0 1 0
  | 0x0b -> direction 0 (-1) 0 | 0x0c -> direction 0 0 1 | 0x0d -> direction 0 0 (-1) | 0x0e -> direction 0 0 0
  | 0x10 ->
    let n = u32 c in
    check c (n lsr 30 = 0) "the highest bits of a direction are not 0";
    let part k = (((n lsr k) land 1023) lxor 512) - 512 in
    direction (part 0) (part 10) (part 20)
  | 0x11 -> TDirection (vector c 0)
  | 0x12 ->
    let normal = vector c (shift c) in
    let rest = many 3 scaled c in
    TPlane ({ normal; nt = rest.(0); nd = rest.(1) }, rest.(2))
  | 0x20 | 0x21 | 0x22 as code -> TDrop (Z.of_int (code - 0x20))
  | 0x30 ->
    let m = uint c in
    check c (m <= 255) "a path is too long";
    let ids = many ((2 * m) + 1) uint c in
    TRing (Z.of_int ids.(0), [List.init m (fun i -> (Z.of_int ids.((2 * i) + 1), Z.of_int ids.((2 * i) + 2)))])
  | _ -> fail c "the byte before this is no token"

let rec take_tokens c strict scene stack =
  if left c = 0 then stack
  else
    match Checker.step strict scene stack (token c) with
    | Some stack -> take_tokens c strict scene stack
    | None -> fail c "the token before this may not be used here"

(* The tree of the proof, if it holds. *)
let prove file claim known c scene =
  let rec tokens stack = function
    | Block b when b.kind = "TOKS" && String.length b.payload <= 1 lsl 20 ->
      let stack = take_tokens (body file b) claim.strict scene stack in
      tokens stack (next file)
    | Commit when stack = [] -> ()
    | _ -> fail c "the proof of this step is not complete, or has another block than TOKS of at most 2^20 bytes" in
  let go_on tree first =
    match Checker.start scene tree with
    | Some stack -> tokens stack first; tree
    | None -> fail c "the tree has not each cell once, or the step makes no sense" in
  match next file, known with
  | Block b, _ when b.kind = "TREE" ->
    let c = body file b in
    let tree = read_tree c (Array.length claim.cells) 0 in
    finish c;
    go_on tree (next file)
  | first, Some tree -> go_on tree first
  | _, None -> fail c "the first step has no tree"

(* The witness in words, if it holds. *)
let refute file claim scene step =
  let c = expect file "WITN" in
  let below n = let i = u32 c in if i < n then Z.of_int i else fail c "a cell or vertex that is not there is named" in
  let list most part =
    let n = u8 c in
    check c (n >= 1 && n <= most) "a number of coefficients or vertices is out of range";
    Array.to_list (many n part c) in
  let side () = list 3 (fun _ -> let v = below (Array.length claim.same) in (v, list 32 sint)) in
  let cells = many 2 (fun _ -> below (Array.length claim.cells)) c in
  let wp = side () in
  let wq = side () in
  let wg = list 32 sint in
  let e = uint c in
  check c (e <= 1024) "the denominator is too long";
  let t = many 2 sint c in
  finish c;
  let w = { Hit.wi = cells.(0); wj = cells.(1); wp; wq; wg; wl = t.(0); wu = t.(1); wd = Z.shift_left Z.one e } in
  check c (Z.sign (List.nth wg (List.length wg - 1)) <> 0) "the last coefficient of g is 0";
  check c (Hit.check_hit claim.strict scene w) "the witness does not hold";
  expect_commit file;
  let names side = String.concat " " (List.map (fun (v, _) -> Z.to_string v) side) in
  Printf.sprintf "in step %d, vertices {%s} of cell %s and {%s} of cell %s meet" (step + 1) (names wp)
    (Z.to_string cells.(0)) (names wq) (Z.to_string cells.(1))

(* How many steps the proof knows of, and the first witness if there is one. seen is how many of the trajectory's
   steps have been read, tree that of the last proof step. *)
let rec check_steps file claim next_motion seen tree words =
  match next file with
  | End when words = None && next_motion () <> None ->
    refuse file (Printf.sprintf "the proof ends after %d steps, but the trajectory goes on" seen)
  | End -> (seen, words)
  | Block b when b.kind = "STEP" ->
    let c = body file b in
    let number = u64 c in
    check c (number >= seen && (words <> None || number = seen)) "a step has the wrong number";
    let rec go_on k = match next_motion () with
      | None -> fail c "the trajectory has no such step"
      | Some m -> if k < number then go_on (k + 1) else m in
    let m = go_on seen and t = many 2 f64 c in
    let units = many 2 i32 c in
    let p = units.(0) and q = units.(1) and kind = u8 c in
    check c (t.(0) = m.t0 && t.(1) = m.t1 && m.t0 < m.t1) "the trajectory's step has another time";
    check c (abs p <= 1200 && abs q <= 1200 && kind <= 1) "a field of the step has an impossible value";
    check c (take c 32 = Lazy.force m.hash) "the step is about another motion than that of the trajectory";
    finish c;
    require_merged c claim m;
    if kind = 0 then
      let tree = prove file claim tree c (scene_of c claim m p q claim.ring Fun.id) in
      check_steps file claim next_motion (number + 1) (Some tree) words
    else
      (* A witness names vertices after merging. Paths are searched: no shortest one has as many edges as vertices. *)
      let ring = min claim.ring (Array.length claim.same) and merged = Array.map (fun v -> claim.same.(v)) in
      let found = refute file claim (scene_of c claim m p q ring merged) number in
      check_steps file claim next_motion (number + 1) tree (if words = None then Some found else words)
  | _ -> refuse file "expected a block STEP before this"

let print_claim claim steps =
  let merged = ref 0 in
  Array.iteri (fun v s -> if v <> s then incr merged) claim.same;
  Printf.printf "%d steps of %s; dimension %d; %d cells of %d vertices.\n" steps
    [| "frames, straight lines between them"; "frames at rest"; "a run" |].(claim.source) claim.dimension
    (Array.length claim.cells) (Array.length claim.same);
  Printf.printf "Compared: features of two different cells%s.\n" (if claim.strict then ", and of one" else "");
  if claim.points then print_endline "Vertices without a cell are points.";
  if !merged > 0 then Printf.printf "Merged: %d vertices, each always where another is.\n" !merged;
  if claim.eta > 0.0 then Printf.printf "Least distance %.17g, ring %d.\n" claim.eta claim.ring;
  if claim.excluded <> [] then print_string "Not compared, pairs of labels:";
  List.iter (fun (a, b) -> Printf.printf " %d-%d" a b) claim.excluded;
  if claim.excluded <> [] then print_newline ()

let run proof paths =
  let file = open_file proof "PROF" in
  let claim, next_motion = read_claim file paths in
  let steps, words = check_steps file claim next_motion 0 None None in
  print_endline (match words with None -> "accepted: nothing touches" | Some w -> "refuted: " ^ w);
  print_claim claim steps;
  flush stdout;
  if words = None then 0 else 1

let () =
  let say where why = (try Printf.printf "rejected: %s: %s\n%!" where why with _ -> ()); 3 in
  exit
    (match Array.to_list Sys.argv with
     | _ :: proof :: (_ :: _ as paths) -> (
       try run proof paths with Rejected (where, why) -> say where why | e -> say "the checker" (Printexc.to_string e))
     | _ -> say "the command line" "expected a proof, and frames or a trajectory.blocks")
