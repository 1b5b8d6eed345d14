(* SPDX-License-Identifier: Apache-2.0 *)
(* Block files (trajectory/FORMAT.md), one committed group after another.
   A group counts when its commit was right: before that, nobody has vouched for its blocks. *)
open Input

type file = {
  name : string; channel : in_channel; size : int; mutable at : int;
  mutable groups : int;     (* commits so far *)
  mutable blocks : int;     (* of the open group *)
  mutable committed : int;  (* where it begins *)
  mutable group : Sha256.t; mutable running : string;
}

(* The offset is that of the payload. *)
type block = { kind : string; payload : string; offset : int }
type next = Block of block | Commit | End

let refuse f at why = reject (Printf.sprintf "%s, byte %d" f.name at) why

let read f n =
  if n > f.size - f.at then refuse f f.at "the file is too short";
  f.at <- f.at + n;
  really_input_string f.channel n

let open_file name content =
  let channel = open_in_bin name in
  let f = { name; channel; size = in_channel_length channel; at = 0; groups = 0; blocks = 0; committed = 0;
            group = Sha256.create (); running = String.make 32 '\000' } in
  let head = read f 16 in
  if head <> "\x89NOLI\r\n\x1a\001\000\000\000" ^ content then refuse f 0 ("expected version 1 of content " ^ content);
  Sha256.add f.group head;
  f

let commit f payload offset =
  let c = cursor f.name offset payload in
  if left c <> 72 || u64 c <> f.groups then refuse f offset "a commit has the wrong length or number";
  let group = Sha256.digest f.group and running = Sha256.create () in
  Sha256.add running f.running;
  Sha256.add running group;
  f.running <- Sha256.digest running;
  if take c 32 <> group || take c 32 <> f.running then refuse f offset "a hash of the group is wrong";
  f.group <- Sha256.create ();
  f.blocks <- 0;
  f.groups <- f.groups + 1;
  f.committed <- f.at

let next f =
  if f.at = f.size then
    if f.blocks <> 0 || f.groups = 0 then
      refuse f f.committed (Printf.sprintf "the group that begins here has no commit; %d groups before it have one" f.groups)
    else End
  else begin
    if f.size - f.at < 16 then refuse f f.at "the file ends within a block";
    let head = read f 12 in
    let length = String.get_int64_le head 4 and offset = f.at in
    if Int64.compare length 0L < 0 || Int64.compare length (Int64.of_int (f.size - f.at - 4)) > 0 then
      refuse f (f.at - 8) "a length goes beyond the file";
    let payload = read f (Int64.to_int length) in
    let sum = read f 4 in
    if Int32.to_int (String.get_int32_le sum 0) land mask <> crc32c [head; payload] then
      refuse f (f.at - 4) "the checksum is wrong";
    let kind = String.sub head 0 4 in
    if kind = "CMIT" then (commit f payload offset; Commit)
    else begin
      List.iter (Sha256.add f.group) [head; payload; sum];
      f.blocks <- f.blocks + 1;
      Block { kind; payload; offset }
    end
  end

let body f b = cursor f.name b.offset b.payload

(* The next block, which has to be of that kind. *)
let expect f kind =
  match next f with
  | Block b when b.kind = kind -> body f b
  | _ -> refuse f f.at ("expected a block " ^ kind ^ " before this")

let expect_commit f = if next f <> Commit then refuse f f.at "expected a commit before this"
