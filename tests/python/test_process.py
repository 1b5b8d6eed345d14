# SPDX-License-Identifier: Apache-2.0
"""What a long-lived interpreter needs: no leaks, bounded memory, threads, Ctrl-C at any moment, its own arithmetic."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
import tracemalloc

import noli
import numpy as np
from support import ROOT, TestCase, falling_sheet, grid


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as text:
        return int(text.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def peak_of(code):
    """The largest resident size of an interpreter that runs this, in bytes."""
    code = textwrap.dedent(code) + "\nimport resource\nprint(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return int(done.stdout.split()[-1])


class Process(TestCase):
    def setUp(self):
        super().setUp()
        self.V, self.F, bodies = falling_sheet(4)
        self.mesh = noli.CollisionMesh(self.F, bodies=bodies)

    def test_no_leak(self):
        def work():
            noli.verify(self.V, self.mesh, check=False, threads=1).to_json()
            noli.time_of_impact(self.V[3], self.V[4], self.mesh, threads=1)
            noli.vertex_face_contact(np.zeros((3, 4, 3)), np.ones((3, 4, 3)), threads=1)
            try:
                noli.verify(self.V * np.nan, self.mesh, check=False)
            except noli.InputError:
                pass

        for _ in range(200):
            work()
        before = resident_bytes()
        tracemalloc.start()
        traced = tracemalloc.get_traced_memory()[0]
        for _ in range(2000):
            work()
        self.assertLess(tracemalloc.get_traced_memory()[0] - traced, 200_000)
        tracemalloc.stop()
        self.assertLess(resident_bytes() - before, 8_000_000)

    def test_a_generator_takes_the_memory_of_two_frames(self):
        code = """
            import sys
            sys.path[:0] = {path!r}
            import noli
            from support import grid
            import numpy as np
            x, faces = grid(150)
            def frames():
                for k in range({count}):
                    yield x + np.array([0.001 * k, 0, 0])
            result = noli.verify(frames(), faces, check={check})
            assert result.verdict in ("proved", "no_contact"), result
        """
        for check in (False, True):
            two, many = (peak_of(code.format(path=sys.path, count=count, check=check)) for count in (2, 60))
            self.assertLess(many, 1.3 * two)

    def test_two_threads_at_once(self):
        results = {}

        def work(name, frames):
            results[name] = [noli.verify(frames, self.mesh).verdict for _ in range(20)]

        threads = [threading.Thread(target=work, args=(n, f)) for n, f in (("a", self.V), ("b", self.V[:4]))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results, {"a": ["contact"] * 20, "b": ["proved"] * 20})

    def test_other_threads_go_on(self):
        x, faces = grid(120)
        counted = 0

        def count():
            nonlocal counted
            while not done:
                counted += 1
                time.sleep(0.001)

        done = False
        thread = threading.Thread(target=count)
        thread.start()
        noli.verify([x, x + 1e-3, x], faces, check=False)
        done = True
        thread.join()
        self.assertGreater(counted, 3)

    def test_interrupted_at_any_moment(self):
        V, F, _ = falling_sheet(40)
        calls = [
            lambda: noli.verify(V[:4], F),
            lambda: noli.verify(iter(list(V[:4]) * 10), F),
            lambda: noli.time_of_impact(V[0], V[5], F),
            lambda: noli.contacts("edge_edge", *np.random.default_rng(1).random((2, 100_000, 4, 3))),
            lambda: noli.repair(V, F),
        ]
        interrupted = 0
        for k, call in enumerate(calls * 6):
            timer = threading.Timer(0.003 + 0.01 * k, os.kill, (os.getpid(), signal.SIGINT))
            began = time.monotonic()
            try:
                timer.start()
                call()
                timer.join()
                time.sleep(0.1)
            except KeyboardInterrupt:
                interrupted += 1
            self.assertLess(time.monotonic() - began, 60)
            timer.join()
        self.assertGreater(interrupted, 10)
        self.assertEqual(noli.verify(V[:4], F).verdict, "proved")

    def test_the_interpreter_ends_while_threads_work(self):
        calls = (
            "noli.verify(V, F, threads=1, check=False)",
            "noli.verify(iter(V), F, threads=1, check=False)",
            "[noli.time_of_impact(V[0], V[1], F) for _ in range(10**6)]",
            "[noli.contacts('edge_edge', Q, Q) for _ in range(10**6)]",
        )
        for call in calls:
            code = f"""
                import sys, threading, time
                sys.path[:0] = {sys.path!r}
                import numpy as np, noli
                from support import falling_sheet
                V, F, _ = falling_sheet(100, 30, 0.01)
                Q = np.random.default_rng(1).random((10**5, 4, 3))
                threading.Thread(target=lambda: {call}, daemon=True).start()
                time.sleep(0.2)
            """
            done = subprocess.run(
                [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=False, timeout=60
            )
            self.assertEqual(done.returncode, 0, call + done.stderr)
            self.assertNotIn("terminate", done.stderr)

    def test_the_child_of_a_fork_works_and_ends(self):
        """Also when another thread of its parent is at work."""
        code = f"""
            import os, sys, threading, time
            sys.path[:0] = {sys.path!r}
            import noli
            from support import falling_sheet
            V, F, _ = falling_sheet(100, 30, 0.01)
            small, faces, _ = falling_sheet(4)
            noli.verify(small[:4], faces, check=False)  # with all threads
            simulation = noli.simulate({str(ROOT / "scenes" / "swinging_cloth.json")!r}, {str(self.folder / "run")!r})
            next(simulation)
            thread = threading.Thread(target=lambda: noli.verify(V, F, threads=1, check=False), daemon=True)
            thread.start()
            time.sleep(0.2)
            assert thread.is_alive()
            if os.fork() == 0:
                for threads in (1, 0):
                    assert noli.verify(small, faces, threads=threads).verdict == "contact"
                    assert noli.verify(small[:4], faces, threads=threads).verdict == "proved"
                try:
                    next(simulation)
                except noli.UsageError:
                    simulation.close()
                    del simulation
                    sys.exit(7)
            next(simulation)
            simulation.close()
            assert os.waitstatus_to_exitcode(os.wait()[1]) == 7
        """
        done = subprocess.run(
            [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=False, timeout=60
        )
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_signal_handler_may_close_a_simulation(self):
        simulation = noli.simulate(ROOT / "scenes" / "swinging_cloth.json", self.folder / "run")
        before = signal.signal(signal.SIGALRM, lambda *_: simulation.close())
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.5)
        began = time.monotonic()
        for _ in simulation:
            pass
        self.assertLess(time.monotonic() - began, 30)
        simulation.close()
        self.assertEqual(simulation.verdict, "undecided")

    def test_stops_soon(self):
        V, F, _ = falling_sheet(150)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(1000):
                noli.verify(V[:4], F)
        self.assertLess(time.monotonic() - began, 2)

    def test_stops_while_it_waits_for_a_pipe(self):
        pipe = self.folder / "pipe.ply"
        os.mkfifo(pipe)
        frame = self.folder / "frame.obj"
        rows = [f"v {x!r} {y!r} {z!r}\n" for x, y, z in self.V[0].tolist()]
        frame.write_text("".join(rows + [f"f {a} {b} {c}\n" for a, b, c in (self.F + 1).tolist()]))
        proof, scene = self.folder / "a.noli", self.folder / "scene.json"
        noli.verify([frame, frame], proof=proof)
        os.mkfifo(scene)
        for call in (
            lambda: noli.verify([frame, pipe]),
            lambda: noli.check(pipe, self.V[:2], self.F),
            lambda: noli.check(pipe, [frame, frame]),
            lambda: noli.read_frames([pipe]),
            lambda: noli.repair([frame, pipe]),
            lambda: noli.check(proof, [frame, pipe]),
            lambda: noli.check(proof, {"sheet": [frame, pipe]}),
            lambda: noli.simulate(scene, self.folder / "run").finish(),
        ):
            timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
            began = time.monotonic()
            timer.start()
            try:
                with self.assertRaises(KeyboardInterrupt):
                    call()
            finally:
                timer.cancel()
            self.assertLess(time.monotonic() - began, 5)

    def test_the_arithmetic_of_the_process_does_not_matter(self):
        """Libraries that are built with -ffast-math make processors flush subnormal numbers to 0."""
        source = self.folder / "flush.c"
        source.write_text("#include <xmmintrin.h>\nvoid flush(void) { _mm_setcsr(_mm_getcsr() | 0x8040 | 0x6000); }\n")
        library = self.folder / "flush.so"
        if subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source], check=False).returncode != 0:
            self.skipTest("no compiler, or another processor")
        code = f"""
            import ctypes, sys
            sys.path[:0] = {sys.path!r}
            import numpy as np, noli
            ctypes.CDLL({str(library)!r}).flush()
            tiny = np.array([4e-320])
            assert (tiny * 0.5)[0] == 0, "the processor does not flush subnormal numbers"
            x = np.array([[[4e-320, 0], [0, 4e-320]]] * 2000)
            found = noli.vertex_vertex_contact(x, x)
            assert not found.touches.any(), "subnormal numbers became 0"
            y = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, 4e-320], [0.3, 0.2, 1], [0.2, 0.3, 1]])
            assert noli.verify([y, y], [[0, 1, 2], [3, 4, 5]]).verdict == "proved"
        """
        subprocess.run([sys.executable, "-c", textwrap.dedent(code)], check=True)
