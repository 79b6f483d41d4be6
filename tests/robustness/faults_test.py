# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Named faults, one after the other, on one daemon: each is followed by a good frame that must be served."""
import os
import random
import resource
import signal
import struct
import subprocess

from trial import BIN, CLOUDS, HANDLES, LIST, PROCESSED, STATUS, TYPES, Process, Trial, options_of, run_trial, wait_until

OPTIONS = options_of(__doc__, only="")
CONFIG = """
lcm: {retry_longest_s: 0.2, control_channel: GRASPD_CONTROL}
limits: {max_message_bytes: 20000000, max_points: 1100000, max_sources: 8}
sources:
  - {name: camera, channel: GRASPD_CLOUD, policy: all, queue_length: 100}
  - {name: more, channel: "MORE_.*", handles_channel: HANDLES_MORE}
"""
CLOUD, IMAGE = TYPES["point_cloud_t"], TYPES["depth_image_t"]
MEGABYTE = 1 << 20


def fault(name, expected):
    """Marks a method as a fault; its docstring says how it is injected."""
    def mark(method):
        method.fault = (name, expected)
        return method
    return mark


class Faults(Trial):
    def setUp(self):
        super().setUp()
        self.cloud = self.record_frames(1, kind="cloud", width=160)[0]
        self.image = self.record_frames(1, kind="depth", width=160)[0]
        self.seq, self.answers, self.status = 100, [], None
        self.listener = self.listen(self.note, {HANDLES, STATUS, "HANDLES_MORE"})
        self.start_one()

    def start_one(self):
        self.config = self.write_config(CONFIG)
        self.status = None
        self.daemon = self.start_listening("graspd", "--config", self.config)
        self.until(lambda: self.status and self.status.pid == self.daemon.process.pid, "the first status")

    def note(self, channel, data):
        if channel == STATUS:
            self.status = TYPES["status_t"].decode(data)
        else:
            self.answers.append((channel, TYPES["handle_list_t"].decode(data)))

    def until(self, condition, what):
        return wait_until(lambda: (self.listener.receive(0.02), condition())[1], what)

    def answers_to(self, messages, channel=CLOUDS, out=HANDLES):
        """The answers on a channel to these messages."""
        before = sum(c == out for c, _ in self.answers)
        for message in messages:
            self.send_paced(self.listener, channel, message)
        while (count := sum(c == out for c, _ in self.answers)) < before + len(messages):  # however long it takes
            self.until(lambda n=count: sum(c == out for c, _ in self.answers) > n, "the next answer")
        return [a for c, a in self.answers if c == out][before:]

    def names(self, *messages):
        """The answers' statuses by name, without repetition."""
        found = {a.status for a in self.answers_to(messages)}
        return ", ".join(sorted(key for key, value in LIST.items() if value in found))

    def good(self, frame=None):
        self.seq += 1
        return self.with_seq(frame or self.cloud, self.seq)

    def changed_cloud(self, **changes):
        return CLOUD.encode(**{**vars(self.cloud), **changes})

    def points(self, values):
        """A cloud of these coordinates, repeated to some length."""
        data = b"".join(struct.pack("<fff", *p) for p in values)
        fields = self.cloud.fields[:3]
        return self.changed_cloud(width=len(values), height=1, fields=fields, num_fields=3, point_step=12,
                                  data_size=len(data), data=data)

    # What comes in.

    @fault("not a number", "NO_FINITE_POINTS")
    def fault_nan(self):
        """a cloud of NaN and infinities"""
        return self.names(self.points([(float("nan"), float("inf"), float("-inf"))] * 500))

    @fault("denormals", "NO_HANDLES or NOTHING_IN_WORKSPACE")
    def fault_denormals(self):
        """coordinates of 1e-45 m"""
        return self.names(self.points([(1e-45, -1e-45, 1e-45)] * 500))

    @fault("huge coordinates", "NOTHING_IN_WORKSPACE")
    def fault_huge(self):
        """coordinates of 1e30 m"""
        return self.names(self.points([(1e30, -1e30, 1e30)] * 500))

    @fault("all points equal", "NO_HANDLES")
    def fault_equal(self):
        """5,000 times the same point"""
        return self.names(self.points([(0.1, 0.2, 0.7)] * 5000))

    @fault("points on a line", "NO_HANDLES")
    def fault_line(self):
        """5,000 points on one line"""
        return self.names(self.points([(0.0001 * i, 0.0001 * i, 0.7) for i in range(5000)]))

    @fault("a million points in one cell", "NO_HANDLES")
    def fault_million(self):
        """10^6 points within one voxel"""
        data = struct.pack("<fff", 0.1, 0.2, 0.7) * 1_000_000
        return self.names(self.changed_cloud(width=1_000_000, height=1, fields=self.cloud.fields[:3], num_fields=3,
                                             point_step=12, data_size=len(data), data=data))

    @fault("no points", "EMPTY_CLOUD")
    def fault_empty(self):
        """a cloud of 0 points, an image of 0 x 480 pixels"""
        none = IMAGE.encode(**{**vars(self.image), "width": 0, "data_size": 0, "data": b""})
        return self.names(self.changed_cloud(width=0, height=1, data_size=0, data=b""), none)

    @fault("counts of 2^31", "REFUSED")
    def fault_counts(self):
        """2^31 - 1 and -2^31 for width, height, number of fields, length of the name"""
        good, places = self.good(), (24, 24 + 4 + len(self.cloud.frame_name) + 1 + 24)
        lies = []
        for value in (0x7FFFFFFF, -0x80000000):
            for at in (places[0], places[1], places[1] + 4, places[1] + 8):
                lies.append(good[:at] + struct.pack(">i", value) + good[at + 4:])
        return self.names(*lies)

    @fault("lying data size", "REFUSED")
    def fault_size(self):
        """data_size of 2^31 - 1, -1, one too many"""
        size = self.cloud.data_size
        at = len(self.good()) - size - 4
        return self.names(*[self.good()[:at] + struct.pack(">i", v) + self.good()[at + 4:] for v in (0x7FFFFFFF, -1, size + 1)])

    @fault("wrong endianness", "an answer, whatever it says")
    def fault_endianness(self):
        """coordinates with their bytes the other way round; then all of the header so"""
        data = b"".join(self.cloud.data[i:i + 4][::-1] for i in range(0, len(self.cloud.data), 4))
        little = self.good()[:8] + struct.pack("<qq", 1, 2) + struct.pack("<i", 1) + self.good()[28:]
        return self.names(self.changed_cloud(data=data), little)

    @fault("truncated messages", "REFUSED")
    def fault_truncated(self):
        """a cloud cut at 40 places"""
        whole = self.good()
        return self.names(*[whole[:len(whole) * i // 40] for i in range(40)])

    @fault("unknown types", "REFUSED")
    def fault_unknown(self):
        """our own answers and status, random fingerprints"""
        noise = random.Random(1)
        return self.names(TYPES["stage_time_t"].encode(stage="x", milliseconds=1.0), *[noise.randbytes(100) for _ in range(10)])

    @fault("a message over the limit", "REFUSED")
    def fault_too_large(self):
        """30 MB where 20 MB are allowed"""
        return self.names(CLOUD.fingerprint + bytes(30 * MEGABYTE))

    @fault("too many points", "REFUSED")
    def fault_too_many(self):
        """1.2 million points where 1.1 million are allowed"""
        data = bytes(12 * 1_200_000)
        return self.names(self.changed_cloud(width=1_200_000, height=1, fields=self.cloud.fields[:3], num_fields=3,
                                             point_step=12, data_size=len(data), data=data))

    @fault("noise on the port", "nothing at all")
    def fault_noise(self):
        """2,000 datagrams of random bytes"""
        noise = random.Random(2)
        for i in range(2000):
            self.listener.send_datagram(noise.randbytes(noise.randrange(1, 1400)))
            if i % 50 == 0:
                self.listener.receive(0.001)
        return "nothing at all"

    @fault("fragments that never end", "memory stays within 400 MB")
    def fault_fragments(self):
        """3,000 first fragments of messages of 60 kB to 300 MB"""
        process = Process(self.daemon.process.pid)
        before = process.rss_bytes()
        for i in range(3000):
            header = struct.pack(">IIIIHH", 0x4C433033, 1_000_000 + i, (i + 1) * 100_000, 0, 0, min(65535, i + 2))
            self.listener.send_datagram(header + b"GRASPD_CLOUD\0" + bytes(1000))
            if i % 50 == 0:
                self.listener.receive(0.001)
        grown = (process.rss_bytes() - before) / MEGABYTE
        self.assertLess(grown, 400)
        return "memory stays within 400 MB"

    # What sources do.

    @fault("a source appears", "served")
    def fault_appears(self):
        """a channel that a regular expression matches"""
        return self.served(self.answers_to([self.good()], "MORE_1", "HANDLES_MORE"))

    @fault("a source vanishes", "the status says since when")
    def fault_vanishes(self):
        """no message any more"""
        self.until(lambda: all(s.age > 1.5 for s in self.status.sources if s.received), "the age in the status")
        return "the status says since when"

    @fault("a source changes its size", "served")
    def fault_size_changes(self):
        """every second pixel, then all again"""
        half = IMAGE.encode(**{**vars(self.image), "height": self.image.height // 2, "data_size": self.image.data_size // 2,
                               "data": self.image.data[:self.image.data_size // 2]})
        return self.served(self.answers_to([half, self.good(self.image), half]))

    @fault("a source changes its type", "served")
    def fault_type_changes(self):
        """cloud, image, cloud, image"""
        return self.served(self.answers_to([self.good(), self.good(self.image), self.good(), self.good(self.image)]))

    @fault("a driver starts again", "served")
    def fault_seq_back(self):
        """sequence numbers and times begin anew; times of year 0 and 292,277"""
        messages = [self.with_seq(self.cloud, 0)]
        for utime in (-(1 << 63), 0, (1 << 63) - 1):
            messages.append(self.changed_cloud(utime=utime, seq=1))
        return self.served(self.answers_to(messages))

    @fault("frames twice", "each answered")
    def fault_duplicates(self):
        """the same message ten times"""
        answers = self.answers_to([self.good()] * 10)
        self.assertEqual({a.seq for a in answers}, {self.seq})
        return "each answered"

    @fault("channels without end", "counted, no more than the limit served")
    def fault_channels(self):
        """200 channels where 8 are allowed"""
        before = self.status.ignored
        for i in range(200):
            self.send_paced(self.listener, f"MORE_{i + 10}", b"x")
        self.until(lambda: self.status.ignored > before + 150, "the count in the status")
        self.assertLessEqual(len(self.status.sources), 8)
        return "counted, no more than the limit served"

    # What happens to the process.

    @fault("stopped and continued", "goes on")
    def fault_frozen(self):
        """SIGSTOP, five frames, SIGCONT"""
        self.daemon.process.send_signal(signal.SIGSTOP)
        before = len(self.answers)
        for _ in range(5):
            self.listener.publish(CLOUDS, self.good())
        self.listener.receive(0.2)
        self.daemon.process.send_signal(signal.SIGCONT)
        self.until(lambda: len(self.answers) >= before + 5, "the answers")
        return "goes on"

    @fault("SIGHUP without end", "goes on, with the configuration")
    def fault_hangups(self):
        """100 SIGHUPs"""
        for _ in range(100):
            self.daemon.process.send_signal(signal.SIGHUP)
            self.listener.receive(0.002)
        self.until(lambda: self.status.config_revision > 1, "a reload in the status")
        return "goes on, with the configuration"

    @fault("a bad configuration at a reload", "the old one is kept, the status says why")
    def fault_bad_config(self):
        """nonsense in the file, SIGHUP"""
        self.config.write_text("sources: [", encoding="utf-8")
        self.daemon.process.send_signal(signal.SIGHUP)
        self.until(lambda: self.status.config_error, "the error in the status")
        self.config.write_text(CONFIG, encoding="utf-8")
        self.daemon.process.send_signal(signal.SIGHUP)
        self.until(lambda: not self.status.config_error, "the good one")
        return "the old one is kept, the status says why"

    @fault("the configuration is gone at a reload", "the old one is kept, the status says why")
    def fault_no_config(self):
        """the file is removed, SIGHUP"""
        self.config.unlink()
        self.daemon.process.send_signal(signal.SIGHUP)
        self.until(lambda: self.status.config_error, "the error in the status")
        self.config.write_text(CONFIG, encoding="utf-8")
        self.daemon.process.send_signal(signal.SIGHUP)
        self.until(lambda: not self.status.config_error, "the good one")
        return "the old one is kept, the status says why"

    @fault("nonsense on the control channel", "refused, the status says why")
    def fault_control(self):
        """random bytes, unknown keys, aliases that unfold without end"""
        bomb = "a: &a [x, x]\n" + "".join(f"{c}: &{c} [{', '.join(['*' + p] * 9)}]\n" for p, c in zip("abcdefg", "bcdefgh"))
        control = TYPES["control_t"]
        for number, text in enumerate(("nonsense: 1", bomb, "sources: [[[[", "," * 100)):
            self.listener.publish("GRASPD_CONTROL", control.encode(utime=0, id=number + 1, command=1, text=text))
            self.until(lambda n=number: self.status.control_id == n + 1, "the control in the status")
            self.assertTrue(self.status.config_error, text)
        self.listener.publish("GRASPD_CONTROL", b"noise")
        return "refused, the status says why"

    @fault("no more files", "goes on")
    def fault_descriptors(self):
        """the limit of open files is what is open"""
        pid = self.daemon.process.pid
        resource.prlimit(pid, resource.RLIMIT_NOFILE, (Process(pid).descriptors(), 1024))
        self.assertEqual(self.served(self.answers_to([self.good()] * 3)), "served")
        self.until(lambda: self.status, "a status")
        resource.prlimit(pid, resource.RLIMIT_NOFILE, (1024, 1024))
        return "goes on"

    @fault("no more memory", "the frame FAILED or REFUSED, goes on")
    def fault_memory(self):
        """12 MB frames where the process may take 8 MB more"""
        pid = self.daemon.process.pid
        with open(f"/proc/{pid}/statm", encoding="ascii") as statm:
            used = int(statm.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
        resource.prlimit(pid, resource.RLIMIT_AS, (used + 8 * MEGABYTE, resource.RLIM_INFINITY))
        data = b"".join(struct.pack("<fff", 0.002 * (i % 1000), 0.002 * (i // 1000), 0.7) for i in range(1_000_000))
        message = self.changed_cloud(width=1_000_000, height=1, fields=self.cloud.fields[:3], num_fields=3, point_step=12,
                                     data_size=len(data), data=data)
        before = len(self.answers)
        self.send_paced(self.listener, CLOUDS, message)
        self.listener.receive(1)
        self.assertIsNone(self.daemon.process.poll(), self.daemon.err)
        resource.prlimit(pid, resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        # LCM itself may have had no memory for the message: then nobody knows of it.
        statuses = {a.status for _, a in self.answers[before:]}
        self.assertTrue(statuses <= {LIST["FAILED"], LIST["REFUSED"]} | PROCESSED, statuses)
        return "the frame FAILED or REFUSED, goes on"

    @fault("two daemons on one channel", "both answer")
    def fault_two(self):
        """a second graspd with the same configuration"""
        second = self.start("graspd", "--config", self.config)
        self.until(lambda: self.status.pid == second.process.pid, "its first status")
        self.answers_to([self.good()])
        self.until(lambda: sum(a.seq == self.seq for _, a in self.answers) == 2, "two answers")
        self.assertEqual(second.stop()[0], 0)
        return "both answer"

    @fault("killed and started again", "served at once")
    def fault_killed(self):
        """SIGKILL, a new process"""
        self.daemon.kill()
        self.start_one()
        return "served at once"

    @fault("nobody reads its log", "goes on")
    def fault_full_log(self):
        """standard error is a pipe that is full"""
        self.daemon.stop()
        read_end, write_end = os.pipe()
        self.addCleanup(os.close, read_end)
        os.set_blocking(write_end, False)
        try:
            while True:
                os.write(write_end, bytes(4096))
        except BlockingIOError:
            pass
        os.set_blocking(write_end, True)
        self.run_beside(write_end)
        return "goes on"

    @fault("its log's reader is gone", "goes on")
    def fault_broken_log(self):
        """standard error is a pipe whose other end is closed"""
        self.daemon.stop()
        read_end, write_end = os.pipe()
        os.close(read_end)
        self.run_beside(write_end)
        return "goes on"

    @fault("asked to stop in the middle of its work", "exit 0, every frame answered")
    def fault_stop(self):
        """30 frames, SIGTERM"""
        before = len(self.answers)
        for _ in range(30):
            self.send_paced(self.listener, CLOUDS, self.good())
        self.assertEqual(self.daemon.stop()[0], 0)
        self.until(lambda: len(self.answers) >= before + 30, "the answers")
        self.start_one()
        return "exit 0, every frame answered"

    # The frame around it.

    def served(self, answers):
        return "served" if all(a.status in PROCESSED for a in answers) else "not served"

    def run_beside(self, stderr):
        """A daemon with this standard error, asked for much that it would log; then one as before."""
        process = subprocess.Popen([str(BIN / "graspd"), "--config", str(self.config)], stderr=stderr)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        os.close(stderr)
        self.until(lambda: self.status.pid == process.pid, "its first status")
        self.answers_to([b"nonsense %d" % i for i in range(300)])
        self.assertEqual(self.served(self.answers_to([self.good()])), "served")
        process.terminate()
        wait_until(lambda: process.poll() is not None, "its end")
        self.assertEqual(process.returncode, 0)
        self.start_one()

    def inject(self, method):
        """The result: what happened, or what went wrong."""
        try:
            seen = method()
            if self.served(self.answers_to([self.good()])) != "served":
                return seen, "the good frame after it was not served"
            if self.daemon.process.poll() is not None:
                return seen, "the daemon has ended"
            return seen, ""
        except AssertionError as error:
            return "", str(error).split("\n", maxsplit=1)[0]

    def test_faults(self):
        methods = [getattr(self, n) for n in vars(type(self)) if n.startswith("fault_") and OPTIONS.only in n]
        print("\n| fault | how | expected | result |\n|---|---|---|---|")
        failed = []
        for method in methods:
            name, expected = method.fault
            seen, problem = self.inject(method)
            fits = not problem and (seen in expected or expected in seen or "whatever" in expected)
            print(f"| {name} | {method.__doc__} | {expected} | {'ok' if fits else 'FAILED: ' + (problem or seen)} |", flush=True)
            if not fits:
                failed.append(name)
                self.daemon.kill()
                self.start_one()
        print(f"\n{len(methods)} faults, {len(failed)} failed")
        self.assertEqual(failed, [])
        self.assertEqual(self.daemon.stop()[0], 0, self.daemon.err)


if __name__ == "__main__":
    run_trial()
