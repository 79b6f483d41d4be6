# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Named faults, one after the other, on one daemon: each is followed by a good frame that must be served."""
import os
import resource
import signal
import struct
import subprocess

from message_faults import MessageFaults, fault
from trial import (BIN, CLOUD, CLOUDS, HANDLES, IMAGE, LIST, MEGABYTE, MOST_AT_ONCE, PROCESSED, SANITIZED, STATUS, TYPES,
                   Process, Trial, options_of, run_trial, wait_until)

OPTIONS = options_of(__doc__, only="")
CONFIG = """
lcm: {retry_longest_s: 0.2, control_channel: GRASPD_CONTROL}
limits: {max_message_bytes: 20000000, max_points: 1100000, max_sources: 8}
sources:
  - {name: camera, channel: GRASPD_CLOUD, policy: all, queue_length: 100}
  - {name: more, channel: "MORE_.*", handles_channel: HANDLES_MORE}
"""


class Faults(MessageFaults, Trial):
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
        for number, message in enumerate(messages, 1):
            self.send_paced(self.listener, channel, message)
            if number % MOST_AT_ONCE == 0 or number == len(messages):
                self.await_count(out, before + number)
        return [a for c, a in self.answers if c == out][before:]

    def await_count(self, out, wanted):
        """So many answers on a channel, however long it takes."""
        while (count := sum(c == out for c, _ in self.answers)) < wanted:
            self.until(lambda n=count: sum(c == out for c, _ in self.answers) > n, "the next answer")

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
            if i % MOST_AT_ONCE == 0:
                self.answers_to([self.good()])  # what came before it has been taken, too
        self.until(lambda: self.status.ignored > before + 150, "the count in the status")
        self.assertLessEqual(len(self.status.sources), 8)
        return "counted, no more than the limit served"

    # What happens to the process.

    @fault("stopped and continued", "goes on")
    def fault_frozen(self):
        """SIGSTOP, five frames, SIGCONT"""
        self.daemon.process.send_signal(signal.SIGSTOP)
        before = len(self.answers)
        for _ in range(5):  # small ones: nobody takes them now
            self.listener.publish(CLOUDS, self.good(self.image))
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

    def refused_reload(self):
        """Reloads what is there now, and then the good configuration again."""
        self.daemon.process.send_signal(signal.SIGHUP)
        self.until(lambda: self.status.config_error, "the error in the status")
        self.config.write_text(CONFIG, encoding="utf-8")
        self.daemon.process.send_signal(signal.SIGHUP)
        self.until(lambda: not self.status.config_error, "the good one")
        return "the old one is kept, the status says why"

    @fault("a bad configuration at a reload", "the old one is kept, the status says why")
    def fault_bad_config(self):
        """nonsense in the file, SIGHUP"""
        self.config.write_text("sources: [", encoding="utf-8")
        return self.refused_reload()

    @fault("the configuration is gone at a reload", "the old one is kept, the status says why")
    def fault_no_config(self):
        """the file is removed, SIGHUP"""
        self.config.unlink()
        return self.refused_reload()

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
        """25 frames, SIGTERM"""
        before = sum(c == HANDLES for c, _ in self.answers)
        for _ in range(MOST_AT_ONCE):
            self.send_paced(self.listener, CLOUDS, self.good())
        self.answers_to([b"no cloud"], "MORE_1", "HANDLES_MORE")  # answered at once: it has taken all that came before
        self.assertEqual(self.daemon.stop()[0], 0)
        self.await_count(HANDLES, before + MOST_AT_ONCE)
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
        methods = [getattr(self, n) for kind in (MessageFaults, Faults) for n in vars(kind)
                   if n.startswith("fault_") and OPTIONS.only in n]
        if SANITIZED:  # it ends the process where memory is short
            print("SKIPPED: no more memory, under a sanitizer")
            methods = [m for m in methods if m != self.fault_memory]
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
