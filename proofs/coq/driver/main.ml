(* SPDX-License-Identifier: Apache-2.0 *)
(* noli_check_verified PROOF FRAME... | noli_check_verified PROOF TRAJECTORY
   Checks a proof that nothing touches, or that something does (proofs/FORMAT.md); exit codes are in section 6 there.

   What this does: it reads the files, compares hashes, and turns numbers into integers. Whether a token may be used and
   a witness holds, the functions decide that are extracted from Coq: Checker.start, Checker.step, Hit.check_hit.
   What it does not do: it finds nothing by itself, and shares nothing with the other checker but the document. *)
open Input

type claim = {
  source : int; strict : bool; ring : int; eta : float;
  same : int array;         (* by vertex: the one that stands for it *)
  cells : int array array;  (* before merging *)
  labels : int array; excluded : (int * int) list;
}

let merged_cell claim i = Array.map (fun v -> claim.same.(v)) claim.cells.(i)

let read_merged c source vertices =
  let same = Array.init vertices Fun.id and n = u32 c and before = ref (-1) in
  need c n 8;
  if source = 2 && n <> 0 then fail c "a run has no merged vertices";
  for _ = 1 to n do
    let v = u32 c in
    let s = u32 c in
    if v <= !before || v >= vertices || s >= v || same.(s) <> s then fail c "merged vertices are not in order";
    same.(v) <- s;
    before := v
  done;
  same

let read_excluded c (scene : Motion.scene) =
  let n = u32 c in
  need c n 8;
  let rec read n before acc =
    if n = 0 then List.rev acc
    else
      let a = u32 c in
      let b = u32 c in
      if a > b || (a, b) <= before then fail c "excluded pairs are not in order" else read (n - 1) (a, b) ((a, b) :: acc) in
  let pairs = read n (-1, -1) [] in
  finish c;
  if Option.value scene.excluded ~default:pairs <> pairs then fail c "other pairs are excluded than those of the run";
  pairs

(* The cells of frames, before merging, without those that are redundant after it. *)
let cells_of (mesh : Frames.mesh) same points =
  let used = Array.make mesh.vertices false and all = Array.to_list mesh.cells in
  List.iter (Array.iter (fun v -> used.(v) <- true)) all;
  let of_size n = List.filter (fun c -> Array.length c = n) all in
  let unused = List.filter (fun v -> points && not used.(v)) (List.init mesh.vertices Fun.id) in
  let loose = List.rev_append (List.rev (of_size 1)) (List.rev (List.rev_map (fun v -> [| v |]) unused)) in
  Frames.irredundant mesh.vertices (fun v -> same.(v)) (of_size 3) (of_size 2) loose

let cells_hash claim =
  let s = sink () in
  put_u64 s (Array.length claim.same);
  put_u64 s (Array.length claim.cells);
  let cell i c =
    put_u8 s (Array.length c);
    Array.iter (fun v -> put_u32 s claim.same.(v)) c;
    put_u32 s claim.labels.(i) in
  Array.iteri cell claim.cells;
  sink_digest s

(* CLAM, and the trajectory that it is about; dimension 2 sets z to 0. *)
let read_claim file paths =
  let c = Blocks.expect file "CLAM" in
  let source = u8 c in
  let dimension = u8 c in
  let flags = u8 c in
  if source > 2 || (dimension <> 2 && dimension <> 3) || flags > (if source = 2 then 1 else 3) || u8 c <> 0 then
    fail c "a field of the claim has an impossible value";
  let ring = u32 c in
  let eta = f64 c in
  if Float.sign_bit eta || ring < 1 || (eta = 0.0 && ring > 1) then fail c "an impossible distance or ring";
  let hash = take c 32 in
  let trajectory =
    match paths with
    | [path] when source = 2 -> Motion.of_run path
    | _ when source = 2 -> fail c "the proof is of a run: expected its trajectory.blocks, one file"
    | _ -> Motion.of_frames paths (source = 1) in
  let scene = trajectory.scene in
  let mesh = scene.mesh in
  if source = 2 && dimension <> scene.dimension then fail c "the run has another dimension";
  let same = read_merged c source mesh.vertices in
  let excluded = read_excluded c scene in
  let cells = if source = 2 then mesh.cells else cells_of mesh same (flags land 2 = 2) in
  let labels = if source = 2 then scene.labels else Array.make (Array.length cells) 0 in
  let claim = { source; strict = flags land 1 = 1; ring; eta; same; cells; labels; excluded } in
  if cells = [||] then fail c "a claim about no cells";
  if cells_hash claim <> hash then fail c "the claim is about other cells than those of the trajectory";
  Blocks.expect_commit file;
  let flat (m : Motion.motion) = if dimension = 2 then Array.iteri (fun i _ -> if i mod 3 = 2 then m.x.(i) <- 0.0) m.x; m in
  (claim, fun () -> Option.map flat (trajectory.next ()))

(* Merged vertices are at one place at all times. *)
let require_merged c claim (m : Motion.motion) =
  let compare_places v s =
    if v <> s then
      for k = 0 to (3 * (m.first.(v + 1) - m.first.(v))) - 1 do
        if m.x.((3 * m.first.(v)) + k) <> m.x.((3 * m.first.(s)) + k) then
          fail c (Printf.sprintf "vertex %d is not where the one is that it was merged with" v)
      done in
  Array.iteri compare_places claim.same

(* The scene in the integers of a step, with the cells before or after merging. Paths are made when they are asked for. *)
let scene_of c claim (m : Motion.motion) p q ring cell : Spec.scene =
  let all = Array.for_all in
  if not (is_multiple p claim.eta && is_multiple q m.t0 && is_multiple q m.t1
          && all (is_multiple q) m.times && all (is_multiple p) m.x) then
    fail c "a number of the motion is no multiple of the step's unit";
  let known = Array.make (Array.length claim.same) [] in
  let rec breakpoints i first acc =
    if i < first then acc
    else
      let x = integer p m.x.(3 * i) and y = integer p m.x.((3 * i) + 1) and z = integer p m.x.((3 * i) + 2) in
      breakpoints (i - 1) first ((integer q m.times.(i), { Spec.vx = x; vy = y; vz = z }) :: acc) in
  let path v =
    if known.(v) = [] then known.(v) <- breakpoints (m.first.(v + 1) - 1) m.first.(v) [];
    known.(v) in
  { tbeg = integer q m.t0; tend = integer q m.t1; path = (fun v -> path (Z.to_int v));
    same = (fun v -> Z.of_int claim.same.(Z.to_int v)); ncell = Z.of_int (Array.length claim.cells);
    cell = (fun i -> List.map Z.of_int (Array.to_list (cell (Z.to_int i))));
    label = (fun i -> Z.of_int claim.labels.(Z.to_int i));
    excluded = List.rev (List.rev_map (fun (a, b) -> (Z.of_int a, Z.of_int b)) claim.excluded);
    eta = integer p claim.eta; ring = Z.of_int ring }

let read_tree c claim =
  let rec node depth =
    match uint c with
    | 0 ->
      if depth = 255 then fail c "the tree is too deep";
      let l = node (depth + 1) in
      let r = node (depth + 1) in
      Checker.Join (l, r)
    | code when code <= Array.length claim.cells -> Checker.Cell (Z.of_int (code - 1))
    | _ -> fail c "a cell that is not there is in the tree" in
  let tree = node 0 in
  finish c;
  tree

let vector c s =
  let x = sint c in
  let y = sint c in
  let z = sint c in
  { Spec.vx = Z.shift_left x s; vy = Z.shift_left y s; vz = Z.shift_left z s }

let direction x y z = Checker.TDirection { Spec.vx = Z.of_int x; vy = Z.of_int y; vz = Z.of_int z }

let way c =
  let m = uint c in
  if m > 255 then fail c "a path is longer than 255";
  let v0 = uint c in
  let step _ = let i = uint c in let v = uint c in (Z.of_int i, Z.of_int v) in
  Checker.TRing (Z.of_int v0, Array.to_list (Array.init m step))

let half_space c =
  let normal = vector c (shift c) in
  let nt = scaled c in
  let nd = scaled c in
  Checker.TPlane ({ normal; nt; nd }, scaled c)

let token c =
  match u8 c with
  | 0x00 -> Checker.THalve | 0x01 -> TLeft | 0x02 -> TRight | 0x03 -> TParts | 0x04 -> TOne | 0x05 -> TBoth | 0x06 -> TExcluded
  | 0x08 -> direction 1 0 0 | 0x09 -> direction (-1) 0 0 | 0x0a -> direction 0 1 0 | 0x0b -> direction 0 (-1) 0
  | 0x0c -> direction 0 0 1 | 0x0d -> direction 0 0 (-1) | 0x0e -> direction 0 0 0
  | 0x10 ->
    let w = u32 c in
    if w lsr 30 <> 0 then fail c "the highest bits of a direction are not 0";
    let part k = let n = (w lsr (10 * k)) land 1023 in if n < 512 then n else n - 1024 in
    direction (part 0) (part 1) (part 2)
  | 0x11 -> TDirection (vector c 0)
  | 0x12 -> half_space c
  | 0x20 | 0x21 | 0x22 as code -> TDrop (Z.of_int (code land 3))
  | 0x30 -> way c
  | _ -> fail c "the byte before this is no token"

(* All tokens of a block. *)
let rec take_tokens c strict scene stack =
  if left c = 0 then stack
  else
    match Checker.step strict scene stack (token c) with
    | Some stack -> take_tokens c strict scene stack
    | None -> fail c "the token before this may not be used here"

let prove file claim known_tree c scene =
  let first = Blocks.next file in
  let tree, first =
    match first, known_tree with
    | Blocks.Block b, _ when b.kind = "TREE" -> (read_tree (Blocks.body file b) claim, Blocks.next file)
    | _, Some tree -> (tree, first)
    | _, None -> fail c "the first step has no tree" in
  let rec tokens stack = function
    | Blocks.Block b when b.kind = "TOKS" && String.length b.payload <= 1 lsl 20 ->
      let stack = take_tokens (Blocks.body file b) claim.strict scene stack in
      tokens stack (Blocks.next file)
    | Blocks.Commit when stack = [] -> ()
    | _ -> fail c "the proof of this step is not complete, or has another block than TOKS of at most 2^20 bytes" in
  (match Checker.start scene tree with
   | Some stack -> tokens stack first
   | None -> fail c "the tree has not all cells, each once, or a path or the step makes no sense");
  tree

let poly c =
  let n = u8 c in
  if n < 1 || n > 32 then fail c "a polynomial has 1 to 32 coefficients";
  List.rev (List.fold_left (fun l _ -> sint c :: l) [] (List.init n Fun.id))

let side c claim =
  let n = u8 c in
  if n < 1 || n > 3 then fail c "expected 1 to 3 vertices";
  let vertex l _ =
    let v = u32 c in
    if v >= Array.length claim.same then fail c "a vertex that is not there is named";
    (Z.of_int v, poly c) :: l in
  List.rev (List.fold_left vertex [] (List.init n Fun.id))

(* The witness in words, if it holds. *)
let refute file claim scene step =
  let c = Blocks.expect file "WITN" in
  let cell () = let i = u32 c in if i >= Array.length claim.cells then fail c "a cell that is not there is named" else i in
  let i = cell () in
  let j = cell () in
  let wp = side c claim in
  let wq = side c claim in
  let wg = poly c in
  let e = uint c in
  if e > 1024 then fail c "the denominator is too long";
  let wl = sint c in
  let wu = sint c in
  finish c;
  let w = { Hit.wi = Z.of_int i; wj = Z.of_int j; wp; wq; wg; wl; wu; wd = Z.shift_left Z.one e } in
  if Z.equal (List.nth wg (List.length wg - 1)) Z.zero then fail c "the last coefficient of g is 0";
  if not (Hit.check_hit claim.strict scene w) then fail c "the witness does not hold";
  Blocks.expect_commit file;
  let names side = String.concat " " (List.map (fun (v, _) -> Z.to_string v) side) in
  Printf.sprintf "in step %d, vertices {%s} of cell %d and {%s} of cell %d meet" step (names wp) i (names wq) j

(* Step after step: how many steps the proof knows of, and the first witness, if there is one. *)
let check_steps file claim next_motion =
  let rec step seen read tree words =
    match Blocks.next file with
    | End ->
      if words = None && next_motion () <> None then
        reject file.name (Printf.sprintf "the proof ends after %d steps, but the trajectory goes on" seen);
      (seen, words)
    | Block b when b.kind = "STEP" -> one (Blocks.body file b) seen read tree words
    | _ -> Blocks.refuse file file.at "expected a block STEP before this"
  and one c seen read tree words =
    let number = u64 c in
    if number < seen || (words = None && number <> read) then fail c "a step has the wrong number";
    let rec go_on k =
      match next_motion () with
      | None -> fail c "the trajectory has no such step"
      | Some m -> if k < number then go_on (k + 1) else m in
    let m : Motion.motion = go_on seen in
    let t0 = f64 c in
    let t1 = f64 c in
    let p = i32 c in
    let q = i32 c in
    let kind = u8 c in
    if t0 <> m.t0 || t1 <> m.t1 || not (t0 < t1) then fail c "the trajectory's step has another time";
    if abs p > 1200 || abs q > 1200 || kind > 1 then fail c "a field of the step has an impossible value";
    if take c 32 <> Motion.hash m then fail c "the step is about another motion than that of the trajectory";
    finish c;
    require_merged c claim m;
    if kind = 0 then
      let scene = scene_of c claim m p q claim.ring (fun i -> claim.cells.(i)) in
      let tree = prove file claim tree c scene in
      step (number + 1) (read + 1) (Some tree) words
    else
      (* A path never needs more edges than there are vertices. *)
      let scene = scene_of c claim m p q (min claim.ring (Array.length claim.same)) (merged_cell claim) in
      let found = refute file claim scene number in
      step (number + 1) (read + 1) tree (if words = None then Some found else words) in
  step 0 0 None None

let print_claim claim steps =
  Printf.printf "%d steps; %d cells of %d vertices; features of %s are compared%s.\n" steps (Array.length claim.cells)
    (Array.length claim.same) (if claim.strict then "one cell" else "two different cells") (if claim.strict then " too" else "");
  if claim.eta > 0.0 then Printf.printf "Least distance %.17g, ring %d.\n" claim.eta claim.ring;
  if claim.excluded <> [] then begin
    print_string "Not compared, pairs of labels:";
    List.iter (fun (a, b) -> Printf.printf " %d-%d" a b) claim.excluded;
    print_newline ()
  end

let check proof paths =
  let file = Blocks.open_file proof "PROF" in
  let claim, next_motion = read_claim file paths in
  let steps, words = check_steps file claim next_motion in
  print_endline (match words with None -> "accepted: nothing touches" | Some w -> "refuted: " ^ w);
  print_claim claim steps;
  flush stdout;
  if words = None then 0 else 1

let () =
  let say where why = (try Printf.printf "rejected: %s: %s\n" where why; flush stdout with _ -> ()); 3 in
  let code =
    try
      match Array.to_list Sys.argv with
      | _ :: proof :: (_ :: _ as paths) -> check proof paths
      | _ -> reject "the command line" "expected a proof, and frames or a trajectory.blocks"
    with
    | Rejected (where, why) -> say where why
    | e -> say "the checker" (Printexc.to_string e) in
  exit code
