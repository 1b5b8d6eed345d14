(* SPDX-License-Identifier: Apache-2.0 *)
(* noli_check_verified [--require FIELD[=VALUE]]... PROOF FRAME...
   noli_check_verified [--require FIELD[=VALUE]]... PROOF TRAJECTORY
   noli_check_verified --version
   Checks a proof that nothing touches, or that something does (proofs/FORMAT.md); for what may be asked and for its
   exit codes see sections 6 and 7.

   What this does: it reads the files, compares hashes, and turns numbers into integers. Whether a token may be used
   and a witness holds, the functions decide that are extracted from Coq: Reading.start_read, Checker.step,
   Hit.check_hit.
   What it does not do: it finds nothing by itself, and shares nothing with the other checker but the document. *)
open Blocks
open Trajectory
open Asked

let read_merged c vertices =
  let same = Array.init vertices Fun.id and n = u32 c and before = ref (-1) in need c n 8;
  for _ = 1 to n do
    let v, s = both u32 c in
    check c (v > !before && v < vertices && s < v && same.(s) = s) "merged vertices are not in order";
    same.(v) <- s; before := v
  done;
  same

(* The cells of frames without those that are redundant after merging, and how many of them are listed; vertices
   without a cell may be points. *)
let cells_of (mesh : Frames.mesh) same points =
  let used = Array.make mesh.vertices (not points) in
  Array.iter (Array.iter (fun v -> used.(v) <- true)) mesh.cells;
  let unused = List.filter (fun c -> not used.(c.(0))) (List.init mesh.vertices (fun v -> [| v |])) in
  let irredundant = Frames.irredundant (fun v -> same.(v)) in
  (irredundant (Array.append mesh.cells (Array.of_list unused)), Array.length (irredundant mesh.cells))

let cells_hash same cells labels =
  let h = hash () and vertex v = text 4 same.(v) in
  let cell i c =
    let size = text 1 (Array.length c) and ids = String.concat "" (Array.to_list (Array.map vertex c)) in
    add h (size ^ ids ^ text 4 labels.(i)) in
  add h (text 8 (Array.length same) ^ text 8 (Array.length cells)); Array.iteri cell cells;
  digest h

(* The end of the first group; before it for frames, perhaps, LABL. *)
let read_labels file is_run cells otherwise =
  match next file with
  | "CMIT", _ -> otherwise
  | kind, c ->
    check c (kind = "LABL" && not is_run) "expected labels of frames, or the end of the claim";
    let labels = Array.map (fun _ -> u32 c) cells in
    finish c; check c (Array.exists (( <> ) 0) labels) "all labels are 0";
    ignore (expect file "CMIT"); labels

(* CLAM: the claim, and the steps that it is about. *)
let read_claim file paths =
  let c = expect file "CLAM" in let source, dimension = both u8 c in
  let flags, zero = both u8 c in
  let ring = u32 c and eta = f64 c and hash = take c 32 and is_run = source = 2 in
  check c (source <= 2 && (dimension = 2 || dimension = 3) && flags <= (if is_run then 1 else 3) && zero = 0
           && not (Float.sign_bit eta) && ring >= 1 && (eta > 0.0 || ring = 1))
    "a field of the claim has an impossible value";
  check c (not is_run || List.length paths = 1) "the proof is of a run: expected its trajectory.blocks, one file";
  let motion = if is_run then of_run (List.hd paths) else of_frames paths dimension (source = 1) in
  let same = read_merged c motion.mesh.vertices in let excluded = pairs u32 c in
  finish c;
  let all = motion.mesh.cells in
  let cells, listed = if is_run then (all, Array.length all) else cells_of motion.mesh same (flags >= 2) in
  check c (not is_run || (dimension = motion.dimension && same = Array.init (Array.length same) Fun.id))
    "the run has another dimension, or merged vertices, which a run has not";
  check c (motion.fits excluded) "other pairs are excluded than those of the run";
  let labels = read_labels file is_run cells (if is_run then motion.labels else Array.map (fun _ -> 0) cells) in
  check c (cells <> [||] && cells_hash same cells labels = hash) "the claim is about other cells, or about none";
  let motion = { motion with labels } in
  { source; points = flags >= 2; strict = flags land 1 = 1; ring; eta; excluded; same; cells; listed; hash; motion }

(* The trajectory of a vertex in integers, all of which are multiples. *)
let read m p q v : Reading.reading =
  let from = m.first.(v) and last = m.first.(v + 1) - 1 in
  let instant i = exact q (time m i) in
  let spot i : Reading.spot =
    let x = coordinate m i 0 and y = coordinate m i 1 and z = coordinate m i 2 in
    let digits bits = Z.of_int (digits p bits) and zeros bits = Z.of_int (zeros p bits) in
    { xm = digits x; xe = zeros x; ym = digits y; ye = zeros y; zm = digits z; ze = zeros z } in
  let rec later i behind = if i = from then behind else later (i - 1) ((instant i, spot i) :: behind) in
  { first_time = instant from; first_spot = spot from; later = lazy (later last []) }

(* The claim about a step, in integers. *)
let scene_of c claim m p q ring cell : Spec.scene =
  let ids numbers = List.map Z.of_int (Array.to_list numbers) in
  { tbeg = integer c q m.t0; tend = integer c q m.t1; path = (fun v -> Reading.traj_of (read m p q (Z.to_int v)));
    same = (fun v -> Z.of_int claim.same.(Z.to_int v)); ncell = Z.of_int (Array.length claim.cells);
    cell = (fun i -> ids (cell claim.cells.(Z.to_int i))); label = (fun i -> Z.of_int claim.motion.labels.(Z.to_int i));
    eta = integer c p claim.eta; ring = Z.of_int ring;
    excluded = List.rev (List.rev_map (fun (a, b) -> (Z.of_int a, Z.of_int b)) claim.excluded) }

let rec read_tree c depth =
  let code = uint c in check c (code > 0 || depth < 255) "the tree is too deep";
  if code > 0 then Checker.Cell (Z.of_int (code - 1))
  else let left = read_tree c (depth + 1) in Checker.Join (left, read_tree c (depth + 1))

let vector part c : Spec.vec = let vx, vy = both part c in { vx; vy; vz = part c }
let direction x y z = Checker.TDirection { vx = Z.of_int x; vy = Z.of_int y; vz = Z.of_int z }

let token c =
  match u8 c with
  | 0x00 -> Checker.THalve | 0x01 -> TLeft | 0x02 -> TRight | 0x03 -> TParts | 0x04 -> TOne | 0x05 -> TBoth
  | 0x06 -> TExcluded | 0x08 -> direction 1 0 0 | 0x09 -> direction (-1) 0 0 | 0x0a -> direction 0 1 0
  | 0x0b -> direction 0 (-1) 0 | 0x0c -> direction 0 0 1 | 0x0d -> direction 0 0 (-1) | 0x0e -> direction 0 0 0
  | 0x10 ->
    let n = u32 c in let part k = (((n lsr k) land 1023) lxor 512) - 512 in
    check c (n lsr 30 = 0) "the highest bits of a direction are not 0";
    direction (part 0) (part 10) (part 20)
  | 0x11 -> TDirection (vector sint c)
  | 0x12 ->
    let s = shift c in let normal = vector (fun c -> Z.shift_left (sint c) s) c in
    let nt, nd = both scaled c in TPlane ({ normal; nt; nd }, scaled c)
  | 0x20 | 0x21 | 0x22 as code -> TDrop (Z.of_int (code - 0x20))
  | 0x30 ->
    let m = uint c and id c = Z.of_int (uint c) in check c (m <= 255) "a path is too long";
    let v = id c in TRing (v, [Array.to_list (many m (both id) c)])
  | _ -> fail c "the byte before this is no token"

(* The last tree that the proof has: of a step that was checked, or not read yet, of one that was passed over. *)
type last_tree = Read of Checker.group option | Unread of cursor

(* The tree of the proof, if it holds; known is the last one before it. *)
let prove file claim known read scene =
  let rec use c stack =
    if left c = 0 then stack
    else match Checker.step claim.strict scene stack (token c) with
      | Some stack -> use c stack
      | None -> fail c "the token before this may not be used here" in
  let rec tokens stack (kind, c) =
    check c (if kind = "TOKS" then left c <= 1 lsl 20 else kind = "CMIT" && stack = [])
      "the proof of this step is not complete, or has another block than TOKS of at most 2^20 bytes";
    if kind = "TOKS" then let stack = use c stack in tokens stack (next file) in
  let kind, c = next file in let has_tree = kind = "TREE" in
  let read_all c = let tree = read_tree c 0 in finish c; Some tree in
  let tree = match known with
    | _ when has_tree -> read_all c | Read tree -> tree | Unread c -> read_all c in
  match Option.bind tree (Reading.start_read (fun v -> read (Z.to_int v)) scene) with
  | None -> fail c "there is no tree, it has not each cell once, or the step makes no sense"
  | Some stack -> tokens stack (if has_tree then next file else (kind, c)); Read tree

(* The last tree after a step that is passed over. *)
let pass_over file is_witness known =
  let rec tokens (kind, c) =
    check c (kind = "TOKS" || kind = "CMIT") "expected a block TOKS or a commit here";
    if kind = "TOKS" then tokens (next file) in
  if is_witness then (ignore (expect file "WITN"); ignore (expect file "CMIT"); known)
  else match next file with
    | "TREE", c -> tokens (next file); Unread c
    | block -> tokens block; known

(* The witness in words, and what it shows, if it holds. *)
let refute file claim number flat scene =
  let c = expect file "WITN" in
  let below n c = let i = u32 c in check c (i < n) "a cell or vertex that is not there is named"; Z.of_int i in
  let list most part c =
    let n = u8 c in check c (n >= 1 && n <= most) "a number of coefficients or vertices is out of range";
    Array.to_list (many n part c) in
  let poly = list 32 sint and vertex = below (Array.length claim.same) in
  let side = list 3 (fun c -> let v = vertex c in (v, poly c)) in
  let wi, wj = both (below (Array.length claim.cells)) c in let wp, wq = both side c in
  let wg = poly c in let e = uint c in
  check c (e <= 8192 && Z.sign (List.hd (List.rev wg)) <> 0) "the denominator is too long, or g begins with 0";
  let wl, wu = both sint c in finish c;
  let w = { Hit.wi; wj; wp; wq; wg; wl; wu; wd = Z.shift_left Z.one e } in
  check c (Hit.check_hit claim.strict scene w) "the witness does not hold"; ignore (expect file "CMIT");
  let near = not (Hit.check_hit claim.strict { scene with eta = Z.zero } w) in
  let names side = String.concat " " (List.map (fun (v, _) -> Z.to_string v) side) in
  let i = Z.to_int wi and j = Z.to_int wj in let a = claim.motion.labels.(i) and b = claim.motion.labels.(j) in
  (Printf.sprintf "in step %d, vertices {%s} of cell %d and {%s} of cell %d %s" (number + 1) (names wp) i (names wq) j
     (if near then "are too near" else "meet"),
   { step = number; one_cell = i = j; of_points = max i j >= claim.listed; near; labels = (min a b, max a b); flat })

(* What the proof has said up to a step.
   known: how many steps it has, up to the last one so far
   steps: how many of them were read from the trajectory
   gaps: a witness was there, after which steps may be missing
   from, until: T0 of the first step that was looked at, T1 of the last one
   proved, proved_until, all_flat: the last step that is proved before a witness, its T1, and whether all are flat
   refuted: the first witness that refutes what is asked, in words
   in_vain: why the first witness does not count that refutes another claim alone *)
type said = { known : int; steps : int; gaps : bool; from : float option; until : float; proved : int;
              proved_until : float; all_flat : bool; refuted : string option; in_vain : string option }

let witnessed said = said.refuted <> None || said.in_vain <> None

(* At the end: whether the claim that is asked is accepted, or refuted, and whether of the first steps alone. *)
let conclude asked claim said =
  if said.refuted <> None then (said, false)
  else begin
    let enough = enough_steps asked claim said.proved in
    Option.iter (fun why -> if not enough then raise (Rejected why)) said.in_vain;
    require_claimed asked claim said.all_flat;
    require_steps asked claim said.proved (not (said.in_vain <> None || enough) && claim.motion.next () <> None);
    ({ said with steps = said.proved; until = said.proved_until }, said.in_vain <> None || claim.motion.more ())
  end

(* The motion of a step, from a trajectory of which came_to steps were read. *)
let find_motion c asked claim came_to number t0 t1 hash =
  let rec go_on k = match claim.motion.next () with
    | Some m -> if k < number then go_on (k + 1) else m
    | None -> fail c "the trajectory has no such step" in
  if asked.is_part && came_to = 0 then claim.motion.pass number;
  let m = go_on (if asked.is_part && came_to = 0 then number else came_to) in
  check c (t0 = m.t0 && t1 = m.t1 && t0 < t1) "the trajectory's step has another time";
  check c (hash = Lazy.force m.hash) "the step is about another motion than the trajectory's";
  m

(* The steps that follow; tree is the last one. The motion of the step before a part is compared too, so that parts which
   follow each other have the same positions between them. *)
let rec check_steps file asked claim tree said =
  match next file with
  | "", c ->
    check c (said.known > 0) "a claim about no steps";
    check c (said.from <> None) "the proof has none of the steps that are asked for"; conclude asked claim said
  | kind, c ->
    let number = if kind = "STEP" then u64 c else fail c "expected a block STEP" in
    check c (number < 1 lsl 53) "a number is too large";
    check c (number >= said.known && (said.gaps || number = said.known)) "a step has the wrong number";
    (* What a large step before this one needed is given back first. *)
    if (Gc.quick_stat ()).heap_words > 1 lsl 23 then Gc.full_major ();
    let t0, t1 = both f64 c in let p, q = both i32 c in
    let is_witness = u8 c in let hash = take c 32 in
    check c (abs p <= 1200 && abs q <= 1200 && is_witness <= 1 && left c = 0)
      "a field of the step has an impossible value";
    let said = { said with known = number + 1; gaps = said.gaps || is_witness = 1 } in
    let find () = find_motion c asked claim said.steps number t0 t1 hash in
    if counts asked claim number then begin
      check c (witnessed said || number = max said.steps (asked.from_step - 1)) "a step before this one is missing";
      check_step file asked claim tree said c number is_witness p q (find ())
    end else begin
      let steps = if number + 2 = asked.from_step then (ignore (find ()); said.known) else said.steps in
      check_steps file asked claim (pass_over file (is_witness = 1) tree) { said with steps }
    end

(* A step that is looked at, and those that follow. *)
and check_step file asked claim tree said c number is_witness p q m =
  let at_one_place v s = check c (v = s || together m v s) "merged vertices are not at one place" in
  Array.iteri at_one_place claim.same; check_multiples c p q m;
  (* A witness names vertices after merging. Paths are searched: no shortest one has as many edges as vertices. *)
  let ring = if is_witness = 0 then claim.ring else min claim.ring (Array.length claim.same) in
  let scene = scene_of c claim m p q ring (if is_witness = 0 then Fun.id else Array.map (fun v -> claim.same.(v))) in
  let from = Some (Option.value said.from ~default:m.t0) in
  let said = { said with steps = number + 1; from; until = m.t1 } in
  if is_witness = 0 then
    let tree = prove file claim tree (read m p q) scene in
    let proved said = { said with proved = said.steps; proved_until = m.t1; all_flat = said.all_flat && m.flat } in
    check_steps file asked claim tree (if witnessed said then said else proved said)
  else
    let words, shown = refute file claim number m.flat scene in
    let now =
      if said.refuted <> None then said
      else
        try require_refuted asked claim shown; { said with refuted = Some (words ^ rests_on claim shown) }
        with Rejected why -> if said.in_vain = None then { said with in_vain = Some why } else said in
    check_steps file asked claim tree now

(* For programs. Of a part of the steps: also the running hash of the whole proof. *)
let print_fields file asked claim said =
  let bit b = if b then 1 else 0 in
  Printf.printf "claim motion=%s dimension=%d steps=%s strict=%d points=%d distance=%s ring=%d merged=%d"
    motions.(claim.source) claim.motion.dimension (steps_text asked said.steps) (bit claim.strict) (bit claim.points)
    (number_text claim.eta) claim.ring (merged claim);
  Printf.printf " excluded=%s cells=%s empty=%d from=%s to=%s%s\n" (pairs_text claim.excluded) (hex claim.hash)
    (bit (not (compares_any claim claim.strict))) (number_text (Option.get said.from)) (number_text said.until)
    (if asked.is_part then " proof=" ^ hex file.running else "")

let run asked proof paths =
  let file = open_file proof "PROF" in let claim = read_claim file paths in
  let begin_ = { known = 0; steps = 0; gaps = false; from = None; until = 0.0; proved = 0; proved_until = 0.0;
                 all_flat = true; refuted = None; in_vain = None } in
  let said, first_steps = check_steps file asked claim (Read None) begin_ in
  let what = if claim.excluded = [] then "nothing touches" else "nothing that is compared touches" in
  print_endline (match said.refuted with
    | Some words -> "refuted: " ^ words | None -> "accepted: " ^ what ^ weaker asked claim said.steps first_steps);
  print_fields file asked claim said;
  let steps = steps_text asked said.steps in
  Printf.printf "%s of %s; from %s to %s; dimension %d; %d cells of %d vertices.\n"
    (if asked.is_part then "Steps " ^ steps else steps ^ " steps")
    [| "frames, straight lines between them"; "frames at rest"; "a run" |].(claim.source)
    (number_text (Option.get said.from)) (number_text said.until) claim.motion.dimension (Array.length claim.cells)
    (Array.length claim.same);
  Printf.printf "Compared: features of two different cells%s.\n" (if claim.strict then ", and of one" else "");
  if claim.points then print_endline "Vertices without a cell are points.";
  if merged claim > 0 then Printf.printf "Merged: %d vertices, each always where another is.\n" (merged claim);
  if claim.eta > 0.0 then Printf.printf "Least distance %.17g, ring %d.\n" claim.eta claim.ring;
  let pairs = List.map (fun (a, b) -> Printf.sprintf " %d-%d" a b) claim.excluded in
  if pairs <> [] then begin
    print_endline ("Not compared, pairs of labels:" ^ String.concat "" pairs);
    let cells = Hashtbl.create 64 in let count label = Option.value (Hashtbl.find_opt cells label) ~default:0 in
    Array.iter (fun label -> Hashtbl.replace cells label (count label + 1)) claim.motion.labels;
    let used = List.sort compare (Hashtbl.fold (fun label n all -> (label, n) :: all) cells []) in
    let text (label, n) = Printf.sprintf " %d with %d;" n label in
    print_endline ("Cells with a label:" ^ String.concat "" (List.map text used) ^ " no others.")
  end;
  flush stdout; if said.refuted = None then 0 else 1

let () =
  let reject why = (try Printf.printf "rejected: %s\n%!" why with _ -> ()); 3 in
  Gc.set { (Gc.get ()) with minor_heap_size = 1 lsl 18; space_overhead = 200 };
  let rec check fields = function
    | "--require" :: field :: words -> check (field :: fields) words
    | proof :: (_ :: _ as paths) -> run (of_words (List.rev fields)) proof paths
    | _ -> raise (Rejected "the command line: expected a proof, and frames or a trajectory.blocks") in
  exit
    (match List.tl (Array.to_list Sys.argv) with
     | ["--version"] -> Printf.printf "noli_check_verified %s\n%!" Version.text; 0
     | words -> (
       try check [] words with
       | Rejected why -> reject why
       | Out_of_memory -> print_string "failed: out of memory; nothing is said of the proof\n"; 4
       | e -> reject ("the checker: " ^ Printexc.to_string e)))
