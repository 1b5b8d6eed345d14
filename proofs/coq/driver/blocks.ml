(* SPDX-License-Identifier: Apache-2.0 *)
(* Bytes that are read one after another, exact numbers, checksums, and block files (trajectory/FORMAT.md).
   Nothing here knows what the bytes are about. *)

(* The check ends: where in which file, and why. *)
exception Rejected of string * string

let reject where why = raise (Rejected (where, why))

(* Each read is within the bytes, or rejected. *)
type cursor = { bytes : string; mutable at : int; file : string; offset : int }

let fail c why = reject (Printf.sprintf "%s, byte %d" c.file (c.offset + c.at)) why
let check c holds why = if not holds then fail c why
let left c = String.length c.bytes - c.at
let need c count size = check c (count <= left c / size) "a length does not fit into what is left"
let skip c n = need c n 1; c.at <- c.at + n; c.at - n  (* where they begin *)
let finish c = check c (left c = 0) "expected the end here"
let take c n = let at = skip c n in String.sub c.bytes at n
let many n part c = Array.init n (fun _ -> part c)
let u8 c = Char.code c.bytes.[skip c 1]
let u16 c = String.get_uint16_le c.bytes (skip c 2)
let i32 c = Int32.to_int (String.get_int32_le c.bytes (skip c 4))
let u32 c = i32 c land 0xffffffff
let is_finite (x : float) = x -. x = 0.0
let same_bits x y = Int64.equal (Int64.bits_of_float x) (Int64.bits_of_float y)

(* Nothing that is 2^62 or more can be right: it counts what takes bytes. *)
let u64 c =
  let n = String.get_int64_le c.bytes (skip c 8) in
  if Int64.shift_right_logical n 62 <> 0L then fail c "a number is too large" else Int64.to_int n

let f64 c =
  let x = Int64.float_of_bits (String.get_int64_le c.bytes (skip c 8)) in
  if is_finite x then x else fail c "expected a finite number"

(* Pairs a <= b, ascending strictly. *)
let pairs n part c =
  let next before _ =
    let p = many 2 part c in
    check c (p.(0) <= p.(1) && (before = [] || compare (List.hd before) (p.(0), p.(1)) < 0)) "pairs are not in order";
    (p.(0), p.(1)) :: before in
  List.rev (List.fold_left next [] (List.init n Fun.id))

(* Groups of seven bits, the lowest first: how many there are. *)
let groups c most =
  let n = ref 1 in
  while !n <= most && !n <= left c && c.bytes.[c.at + !n - 1] >= '\x80' do incr n done;
  check c (!n <= most && !n <= left c) "an integer does not end";
  check c (!n = 1 || c.bytes.[c.at + !n - 1] <> '\000') "an integer is written longer than it is";
  !n

(* The integer of the groups from one to before another, at most eight. *)
let rec of_groups c first last =
  if first = last then 0 else Char.code c.bytes.[first] land 0x7f lor (of_groups c (first + 1) last lsl 7)

(* All that a uint can rightly be is far below 2^56. *)
let uint c =
  let n = groups c 10 in
  check c (n <= 8) "an integer is too large for its place";
  let at = skip c n in
  of_groups c at (at + n)

let sint c =
  let n = groups c 1200 in
  let start = skip c n in
  let rec below last high =
    let first = max start (last - 8) in
    if last = start then high
    else below first (Z.add (Z.shift_left high (7 * (last - first))) (Z.of_int (of_groups c first last))) in
  let u = below (start + n) Z.zero in
  if Z.is_odd u then Z.lognot (Z.shift_right u 1) else Z.shift_right u 1

let shift c = let s = uint c in if s > 4096 then fail c "a shift is above 4,096" else s
let scaled c = let s = shift c in Z.shift_left (sint c) s

(* |x| is m 2^e, with an integer m below 2^53. *)
let split x =
  let bits = Int64.bits_of_float x in
  let e = Int64.to_int (Int64.shift_right_logical bits 52) land 0x7ff and m = Int64.to_int bits land 0xfffffffffffff in
  if e = 0 then (m, -1074) else (m lor 0x10000000000000, e - 1075)

(* Whether x / 2^p is an integer, and that integer. *)
let is_multiple p x = let m, e = split x in e >= p || m = 0 || (p - e <= 52 && m land ((1 lsl (p - e)) - 1) = 0)

let integer p x =
  let m, e = split x in
  let m = if x < 0.0 then -m else m in
  if m = 0 then Z.zero else if e < p then Z.of_int (m asr (p - e)) else Z.shift_left (Z.of_int m) (e - p)

let mask = 0xffffffff

let crc_table = Array.init 256 (fun i ->
  List.fold_left (fun c _ -> (c lsr 1) lxor (if c land 1 = 1 then 0x82F63B78 else 0)) i [1; 2; 3; 4; 5; 6; 7; 8])

let crc32c crc s =
  let crc = ref crc in
  for i = 0 to String.length s - 1 do crc := crc_table.((!crc lxor Char.code s.[i]) land 255) lxor (!crc lsr 8) done;
  !crc

(* SHA-256, FIPS 180-4. What waits is hashed when it is long, so things may be written to it. *)
type hash = { state : int array; waits : Buffer.t; mutable hashed : int }

(* The first 32 fractional bits of roots of the first primes. *)
let roots degree n =
  let is_prime n = List.for_all (fun d -> n = d || n mod d <> 0) [2; 3; 5; 7; 11; 13; 17] in
  let primes = List.filteri (fun i _ -> i < n) (List.filter is_prime (List.init 310 (fun i -> i + 2))) in
  let bits p = Z.to_int (Z.extract (Z.root (Z.shift_left (Z.of_int p) (32 * degree)) degree) 0 32) in
  Array.of_list (List.map bits primes)

let k = roots 3 64 and start = roots 2 8 and w = Array.make 64 0
let hash () = { state = Array.copy start; waits = Buffer.create 65536; hashed = 0 }

(* The same 32 bits twice, one behind the other: shifted, they are rotated. *)
let rec rounds i a b c d e f g h =
  if i = 64 then [| a; b; c; d; e; f; g; h |]
  else
    let ee = e lor (e lsl 32) and aa = a lor (a lsl 32) in
    let s1 = (ee lsr 6) lxor (ee lsr 11) lxor (ee lsr 25) and s0 = (aa lsr 2) lxor (aa lsr 13) lxor (aa lsr 22) in
    let t1 = h + (s1 land mask) + (g lxor (e land (f lxor g))) + k.(i) + w.(i) in
    let t2 = (s0 land mask) + ((a land b) lor (c land (a lor b))) in
    rounds (i + 1) ((t1 + t2) land mask) a b c ((d + t1) land mask) e f g

let compress v s at =
  for i = 0 to 15 do w.(i) <- Int32.to_int (String.get_int32_be s (at + (4 * i))) land mask done;
  for i = 16 to 63 do
    let x = w.(i - 15) and y = w.(i - 2) in
    let xx = x lor (x lsl 32) and yy = y lor (y lsl 32) in
    let s0 = (xx lsr 7) lxor (xx lsr 18) lxor (x lsr 3) and s1 = (yy lsr 17) lxor (yy lsr 19) lxor (y lsr 10) in
    w.(i) <- (w.(i - 16) + (s0 land mask) + w.(i - 7) + (s1 land mask)) land mask
  done;
  Array.iteri (fun i x -> v.(i) <- (v.(i) + x) land mask) (rounds 0 v.(0) v.(1) v.(2) v.(3) v.(4) v.(5) v.(6) v.(7))

let add ?(least = 65536) h s =
  Buffer.add_string h.waits s;
  let all = if Buffer.length h.waits < least then "" else Buffer.contents h.waits in
  let n = String.length all / 64 * 64 in
  for i = 0 to (n / 64) - 1 do compress h.state all (64 * i) done;
  h.hashed <- h.hashed + n;
  if n > 0 then (Buffer.clear h.waits; Buffer.add_substring h.waits all n (String.length all - n))

let digest h =
  let size = h.hashed + Buffer.length h.waits in
  Buffer.add_string h.waits ("\x80" ^ String.make ((119 - size) land 63) '\000');
  Buffer.add_int64_be h.waits (Int64.of_int (8 * size));
  add ~least:0 h "";
  String.init 32 (fun i -> Char.chr ((h.state.(i / 4) lsr (24 - (8 * (i mod 4)))) land 255))

type file = {
  name : string; channel : in_channel; size : int; mutable read : int;
  mutable commits : int; mutable blocks : int;  (* so far; of the open group *)
  mutable group : hash; mutable last : string; mutable running : string;  (* of the open group, the last, all *)
}
type block = { kind : string; payload : string; offset : int }
type next = Block of block | Commit | End

let refuse f why = reject (Printf.sprintf "%s, byte %d" f.name f.read) (Printf.sprintf "%s (%d commits)" why f.commits)

let read f n =
  if n < 0 || n > f.size - f.read then refuse f "a block, or its length, goes beyond the end of the file";
  f.read <- f.read + n;
  really_input_string f.channel n

let open_file name content =
  let channel = open_in_bin name in
  let running = String.make 32 '\000' in
  let f = { name; channel; size = in_channel_length channel; read = 0; commits = 0; blocks = 0; group = hash ();
            last = ""; running } in
  let head = read f 16 in
  if head <> "\x89NOLI\r\n\x1a\001\000\000\000" ^ content then refuse f ("expected version 1, content " ^ content);
  add f.group head;
  f

let commit f c =
  let running = hash () in
  f.last <- digest f.group;
  add running (f.running ^ f.last);
  f.running <- digest running;
  check c (left c = 72 && u64 c = f.commits) "a commit has the wrong length or number";
  check c (take c 64 = f.last ^ f.running) "a hash of the group is wrong";
  f.group <- hash ();
  f.blocks <- 0;
  f.commits <- f.commits + 1

let body f b = { bytes = b.payload; at = 0; file = f.name; offset = b.offset }

(* The next block or commit. A group counts when its commit was right; what has none at the end is refused. *)
let next f =
  if f.read = f.size && f.blocks = 0 && f.commits > 0 then End
  else begin
    if f.size - f.read < 16 then refuse f "the file ends here without a commit";
    let head = read f 12 in
    let offset = f.read and length = u64 { bytes = head; at = 4; file = f.name; offset = f.read - 12 } in
    let payload = read f length in
    let sum = read f 4 in
    let crc = Int32.to_int (String.get_int32_le sum 0) land mask in
    if crc32c (crc32c mask head) payload lxor mask <> crc then refuse f "the checksum is wrong";
    let b = { kind = String.sub head 0 4; payload; offset } in
    if b.kind = "CMIT" then (commit f (body f b); Commit)
    else (List.iter (add f.group) [head; payload; sum]; f.blocks <- f.blocks + 1; Block b)
  end

(* The next block, which has to be of that kind. *)
let expect f kind =
  match next f with Block b when b.kind = kind -> body f b | _ -> refuse f ("expected a block " ^ kind ^ " before this")

let expect_commit f = if next f <> Commit then refuse f "expected a commit before this"
