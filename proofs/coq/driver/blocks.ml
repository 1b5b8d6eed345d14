(* SPDX-License-Identifier: Apache-2.0 *)
(* Bytes that are read one after another, exact numbers, checksums, and block files (trajectory/FORMAT.md).
   Nothing here knows what the bytes are about. *)

(* The check ends: in which file, where, and why. *)
exception Rejected of string

(* Each read is within the bytes, or rejected. *)
type cursor = { bytes : string; mutable at : int; file : string; offset : int }

let cursor file offset bytes = { bytes; at = 0; file; offset }
let fail c why = raise (Rejected (Printf.sprintf "%s, byte %d: %s" c.file (c.offset + c.at) why))
let check c holds why = if not holds then fail c why
let left c = String.length c.bytes - c.at
let need c count size = check c (count <= left c / size) "a length does not fit into what is left"
let skip c n = need c n 1; c.at <- c.at + n; c.at - n  (* where they begin *)
let finish c = check c (left c = 0) "expected the end here"
let take c n = let at = skip c n in String.sub c.bytes at n
let many n part c = Array.init n (fun _ -> part c)
let both part c = let a = part c in (a, part c)
let mask = 0xffffffff
let u8 c = Char.code c.bytes.[skip c 1]
let u16 c = String.get_uint16_le c.bytes (skip c 2)
let i32 c = Int32.to_int (String.get_int32_le c.bytes (skip c 4))
let u32 c = i32 c land mask

(* Nothing that is 2^62 or more can be right: it counts what takes bytes. *)
let small c z = if Z.fits_int z then Z.to_int z else fail c "a number is too large"
let u64 c = small c (Z.of_bits (take c 8))
let finite c (x : float) = check c (x -. x = 0.0) "expected a finite number"; x
let f64 c = finite c (Int64.float_of_bits (String.get_int64_le c.bytes (skip c 8)))
let same_bits x y = Int64.equal (Int64.bits_of_float x) (Int64.bits_of_float y)

(* How many pairs a <= b, and they, ascending strictly. *)
let pairs part c =
  let n = u32 c in need c n 4;
  let all = many n (both part) c in
  Array.iteri (fun i (a, b) -> check c (a <= b && (i = 0 || all.(i - 1) < (a, b))) "pairs are not in order") all;
  Array.to_list all

(* Groups of seven bits, the lowest first, at most so many: none is there without need. *)
let rec groups c most is_first =
  let byte = u8 c in
  check c ((byte > 0 || is_first) && (byte < 128 || most > 1)) "an integer is too long, or does not end";
  let rest = if byte < 128 then Z.zero else groups c (most - 1) false in
  Z.logor (Z.of_int (byte land 127)) (Z.shift_left rest 7)

let uint c = small c (groups c 10 true)
let sint c = let u = groups c 1200 true in Z.logxor (Z.shift_right u 1) (if Z.is_odd u then Z.minus_one else Z.zero)
let shift c = let s = uint c in check c (s <= 4096) "a shift is above 4,096"; s
let scaled c = let s = shift c in Z.shift_left (sint c) s

(* x / 2^p, which has to be an integer; |x| is m 2^(k + p), with an integer m below 2^53. *)
let integer c p x =
  let bits = Int64.to_int (Int64.bits_of_float x) in
  let e = (bits lsr 52) land 0x7ff and fraction = bits land 0xfffffffffffff in
  let m = if e = 0 then fraction else fraction lor 0x10000000000000 and k = (if e = 0 then 1 else e) - 1075 - p in
  check c (m = 0 || k >= 0 || (k > -53 && m land ((1 lsl -k) - 1) = 0)) "a number is no multiple of the step's unit";
  let m = if x < 0.0 then -m else m in
  if m = 0 then Z.zero else if k < 0 then Z.of_int (m asr -k)
  else if k < 9 then Z.of_int (m lsl k) else Z.shift_left (Z.of_int m) k

let crc_table =
  let bit c _ = (c lsr 1) lxor (if c land 1 = 1 then 0x82F63B78 else 0) in
  Array.init 256 (fun byte -> List.fold_left bit byte [1; 2; 3; 4; 5; 6; 7; 8])

let crc32c before s =
  let crc = ref before in
  for i = 0 to String.length s - 1 do crc := crc_table.((!crc lxor Char.code s.[i]) land 255) lxor (!crc lsr 8) done;
  !crc

(* SHA-256, FIPS 180-4. What is less than a block waits. *)
type hash = { state : int array; mutable waits : string; mutable hashed : int }

(* The first 32 fractional bits of roots of the first n primes. *)
let roots degree n =
  let is_prime n = List.for_all (fun d -> n = d || n mod d <> 0) [2; 3; 5; 7; 11; 13; 17] in
  let primes = Array.of_list (List.filter is_prime (List.init 310 (fun i -> i + 2))) in
  let root i = Z.root (Z.shift_left (Z.of_int primes.(i)) (32 * degree)) degree in
  Array.init n (fun i -> Z.to_int (Z.extract (root i) 0 32))

let k = roots 3 64 and start = roots 2 8 and w = Array.make 64 0
let hash () = { state = Array.copy start; waits = ""; hashed = 0 }
let rotated x n = (x lor (x lsl 32)) lsr n  (* in its lowest 32 bits *)

let rec rounds i a b c d e f g h =
  if i = 64 then [| a; b; c; d; e; f; g; h |]
  else
    let s0 = rotated a 2 lxor rotated a 13 lxor rotated a 22 and s1 = rotated e 6 lxor rotated e 11 lxor rotated e 25 in
    let t1 = h + (s1 land mask) + (g lxor (e land (f lxor g))) + k.(i) + w.(i) in
    let t2 = (s0 land mask) + ((a land b) lor (c land (a lor b))) in
    rounds (i + 1) ((t1 + t2) land mask) a b c ((d + t1) land mask) e f g

let compress v s at =
  for i = 0 to 15 do w.(i) <- Int32.to_int (String.get_int32_be s (at + (4 * i))) land mask done;
  for i = 16 to 63 do
    let x = w.(i - 15) and y = w.(i - 2) in
    let s0 = rotated x 7 lxor rotated x 18 lxor (x lsr 3) and s1 = rotated y 17 lxor rotated y 19 lxor (y lsr 10) in
    w.(i) <- (w.(i - 16) + (s0 land mask) + w.(i - 7) + (s1 land mask)) land mask
  done;
  Array.iteri (fun i x -> v.(i) <- (v.(i) + x) land mask) (rounds 0 v.(0) v.(1) v.(2) v.(3) v.(4) v.(5) v.(6) v.(7))

let add h s =
  let all = h.waits ^ s in let n = String.length all / 64 * 64 in
  for i = 0 to (n / 64) - 1 do compress h.state all (64 * i) done;
  h.waits <- String.sub all n (String.length all - n); h.hashed <- h.hashed + String.length s

(* So many bytes of an integer, the lowest first. *)
let text size n = String.init size (fun i -> Char.chr ((n lsr (8 * i)) land 255))
let reversed s = String.init (String.length s) (fun i -> s.[String.length s - 1 - i])

let digest h =
  add h ("\x80" ^ String.make ((119 - h.hashed) land 63) '\000' ^ reversed (text 8 (8 * h.hashed)));
  String.concat "" (List.map (fun x -> reversed (text 4 x)) (Array.to_list h.state))

(* A block file, with how many groups and bytes were read, and hashes of the open group, the last, and all. *)
type file = { name : string; channel : in_channel; size : int; mutable read : int; mutable commits : int;
              mutable is_open : bool; mutable group : hash; mutable last : string; mutable running : string }

let refuse f why = fail (cursor f.name f.read "") (Printf.sprintf "%s (%d commits)" why f.commits)

let read f n =
  if n > f.size - f.read then refuse f "a block, or its length, goes beyond the end of the file";
  f.read <- f.read + n; really_input_string f.channel n

let open_file name content =
  let channel = open_in_bin name and group = hash () and running = String.make 32 '\000' in
  let size = in_channel_length channel in
  let f = { name; channel; size; read = 0; commits = 0; is_open = true; group; last = ""; running } in
  let head = read f 16 in
  if head <> "\x89NOLI\r\n\x1a\001\000\000\000" ^ content then refuse f ("expected version 1, content " ^ content);
  add group head; f

let commit f c =
  let running = hash () in f.last <- digest f.group;
  add running (f.running ^ f.last); f.running <- digest running;
  check c (left c = 72 && u64 c = f.commits && take c 64 = f.last ^ f.running) "a commit has a wrong number or hash";
  f.group <- hash (); f.commits <- f.commits + 1

(* The kind and payload of the next block; "CMIT" for a commit, which was right; "" at the end, behind a commit. *)
let next f =
  if f.read = f.size && not f.is_open then ("", cursor f.name f.read "")
  else begin
    if f.size - f.read < 16 then refuse f "the file ends here without a commit";
    let head = read f 12 in
    let kind = String.sub head 0 4 and length = u64 (cursor f.name f.read (String.sub head 4 8)) in
    let c = cursor f.name f.read (read f length) and sum = read f 4 in
    if text 4 (crc32c (crc32c mask head) c.bytes lxor mask) <> sum then refuse f "the checksum is wrong";
    f.is_open <- kind <> "CMIT";
    if f.is_open then List.iter (add f.group) [head; c.bytes; sum] else commit f c;
    (kind, c)
  end

(* The payload of the next block, which has to be of that kind. *)
let expect f kind = let found, c = next f in check c (found = kind) ("expected a block " ^ kind ^ " here"); c
