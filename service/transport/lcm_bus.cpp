// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/lcm_bus.hpp"

#include <lcm/lcm.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "service/transport/multicast_check.hpp"
#include "service/transport/time_limit.hpp"

namespace graspd {
namespace {

// For each step of a tcpq server: to connect, to shake hands, to take or send some bytes of a message. Less
// than the two seconds in which the daemon has to be gone.
constexpr std::chrono::seconds kServerPatience{1};

[[noreturn]] void fail(const std::string& url, const std::string& reason) {
  throw std::runtime_error("LCM URL '" + url + "': " + reason);
}

[[noreturn]] void fail_for_now(const std::string& url, const std::string& reason) {
  throw BusUnavailable("LCM URL '" + url + "': " + reason);
}

/// LCM takes a host's name for the local host.
std::string with_resolved_host(const std::string& url, const LcmUrl& parsed) {
  const std::size_t colon = std::min(parsed.network.find(':'), parsed.network.size());
  const std::string host = parsed.network.substr(0, colon);
  if (host.empty()) return url;
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, &hints, &found);
  if (error != 0) {
    fail_for_now(url, "no address for host '" + host + "' (" + gai_strerror(error) +
                          "); remedy: check its name, or give its address");
  }
  char address[NI_MAXHOST] = {};
  getnameinfo(found->ai_addr, found->ai_addrlen, address, sizeof(address), nullptr, 0, NI_NUMERICHOST);
  freeaddrinfo(found);
  return "tcpq://" + std::string(address) + url.substr(std::string("tcpq://").size() + host.size());
}

/// Everything that is known to go wrong inside LCM is looked at before LCM sees the URL.
std::string checked_url(const std::string& url, const LcmUrl& parsed) {
  if (parsed.provider == "udpm") require_multicast(url);
  if (parsed.provider == "tcpq") return with_resolved_host(url, parsed);
  return url;
}

std::string no_answer(const LcmUrl& url) {
  return "'" + url.network + "' does not answer as a tcpq server does within " +
         std::to_string(kServerPatience.count()) +
         " s; remedy: check that it is lcm-tcpq-server, and the way to it";
}

std::string creation_failure(const LcmUrl& url) {
  if (url.provider == "file") {
    return "cannot open the log '" + url.network +
           "'; remedy: check that it exists, is readable and is not empty";
  }
  if (url.provider == "tcpq")
    return "cannot connect to '" + url.network + "'; remedy: start lcm-tcpq-server there";
  if (url.provider == "udpm" || url.provider == "memq")
    return "LCM cannot use it; remedy: check the limit of open files";
  return "unknown provider '" + url.provider + "' (expected udpm, tcpq, file or memq)";
}

/// LCM puts ^ and $ around a channel, which bind closer than an alternative.
std::string whole_name(const std::string& channel_regex) {
  return channel_regex.find('|') == std::string::npos ? channel_regex : "(" + channel_regex + ")";
}

}  // namespace

struct LcmBus::Subscription {
  LcmBus* bus;
  std::string channel_regex;
  Handler handler;
  lcm_subscription_t* made_by_lcm = nullptr;

  /// Called by LCM. No exception may pass through its C frames: the first one waits in the bus.
  static void dispatch(const lcm_recv_buf_t* received, const char* channel, void* user) noexcept {
    auto& self = *static_cast<Subscription*>(user);
    try {
      const auto* bytes = static_cast<const std::byte*>(received->data);
      self.handler({channel, {bytes, received->data_size}, received->recv_utime});
    } catch (...) {
      if (!self.bus->handler_error_) self.bus->handler_error_ = std::current_exception();
    }
  }
};

LcmBus::LcmBus(const std::string& url)
    : url_(url), provider_(parse_lcm_url(url).provider), lcm_(nullptr, lcm_destroy) {
  const LcmUrl parsed = parse_lcm_url(url);
  const bool in_time = create(checked_url(url, parsed));
  const bool fixed = provider_ != "udpm" && provider_ != "tcpq";
  if (lcm_ == nullptr && fixed) fail(url, creation_failure(parsed));
  if (lcm_ == nullptr) fail_for_now(url, creation_failure(parsed));
  // LCM returns tcpq connections that were refused. udpm starts its receiver here, which who only publishes
  // is spared.
  if (provider_ != "tcpq") return;
  const int fd = lcm_get_fileno(lcm_.get());
  if (fd < 0) fail_for_now(url, in_time ? creation_failure(parsed) : no_answer(parsed));
  const timeval patience{kServerPatience.count(), 0};
  for (const int direction : {SO_RCVTIMEO, SO_SNDTIMEO})
    setsockopt(fd, SOL_SOCKET, direction, &patience, sizeof(patience));
}

LcmBus::~LcmBus() {
  if (provider_ != "tcpq") return;
  // LCM unsubscribes as it ends, and connects anew to do so: a bus that is closed has no time for that.
  const bool closed = lcm_get_fileno(lcm_.get()) < 0;
  const TimeLimit limit(closed ? std::chrono::seconds(0) : kServerPatience);
  lcm_.reset();
}

bool LcmBus::create(const std::string& url) {
  // LCM connects to a tcpq server, and waits for its greeting, for as long as that likes.
  std::optional<TimeLimit> limit;
  if (provider_ == "tcpq") limit.emplace(kServerPatience);
  lcm_.reset(lcm_create(url.c_str()));
  return !limit || !limit->passed();
}

std::unique_lock<std::recursive_mutex> LcmBus::lock_connection() {
  std::unique_lock lock(use_mutex_, std::defer_lock);
  if (provider_ == "tcpq") lock.lock();
  return lock;
}

void LcmBus::require_receiving() {
  if (lcm_get_fileno(lcm_.get()) >= 0) return;
  fail_for_now(url_,
               "cannot receive; remedy: check the multicast route (ip route add 239.0.0.0/8 dev lo src "
               "127.0.0.1) and the firewall");
}

void LcmBus::subscribe(const std::string& channel_regex, Handler handler, int queue_capacity) {
  const auto lock = lock_connection();  // what is sent to subscribe must not get into a message
  require_receiving();                  // after a failure lcm_subscribe would stall for ten seconds
  auto subscription = std::make_unique<Subscription>(Subscription{this, channel_regex, std::move(handler)});
  lcm_subscription_t* created = lcm_subscribe(lcm_.get(), whole_name(channel_regex).c_str(),
                                              &Subscription::dispatch, subscription.get());
  if (created == nullptr) {
    throw std::runtime_error("LCM channel '" + channel_regex +
                             "': not a regular expression; remedy: correct it");
  }
  subscriptions_.push_back(std::move(subscription));
  lcm_subscription_set_queue_capacity(created, queue_capacity);
  subscriptions_.back()->made_by_lcm = created;
}

void LcmBus::unsubscribe(const std::string& channel_regex) {
  std::erase_if(subscriptions_, [&](const std::unique_ptr<Subscription>& subscription) {
    if (subscription->channel_regex != channel_regex) return false;
    const auto lock = lock_connection();
    // LCM would connect anew; a closed bus calls no handler any more.
    const bool closed = provider_ == "tcpq" && lcm_get_fileno(lcm_.get()) < 0;
    if (!closed) lcm_unsubscribe(lcm_.get(), subscription->made_by_lcm);
    return true;
  });
}

LcmBus::Wait LcmBus::wait(std::chrono::milliseconds timeout) {
  // Not lcm_handle_timeout: its select() aborts on the -1 of a lost connection and on file numbers from 1024.
  const int fd = lcm_get_fileno(lcm_.get());
  if (fd < 0) return Wait::kClosed;
  pollfd waiting{fd, POLLIN, 0};
  const auto milliseconds = std::clamp<std::chrono::milliseconds::rep>(timeout.count(), 0, INT_MAX);
  const int ready = poll(&waiting, 1, static_cast<int>(milliseconds));
  if (ready == 0 || (ready < 0 && errno == EINTR)) return Wait::kTimeout;
  if (ready < 0) throw std::system_error(errno, std::system_category(), "poll");
  if ((waiting.revents & POLLIN) == 0) return Wait::kClosed;

  const int status = handle();
  const bool interrupted = status < 0 && errno == EINTR;
  if (handler_error_) std::rethrow_exception(std::exchange(handler_error_, nullptr));
  if (interrupted) return Wait::kTimeout;
  return status < 0 ? Wait::kClosed : Wait::kHandled;
}

int LcmBus::handle() {
  // Of a tcpq connection that breaks, reader and writers would each close the socket.
  const auto lock = lock_connection();
  errno = 0;
  return lcm_handle(lcm_.get());
}

bool LcmBus::publish(const std::string& channel, std::span<const std::byte> bytes) {
  if (!can_carry(channel, bytes)) return false;
  const std::scoped_lock lock(use_mutex_);
  // LCM would connect anew by itself, and wait for as long as the server likes.
  if (provider_ == "tcpq" && lcm_get_fileno(lcm_.get()) < 0) return false;
  return lcm_publish(lcm_.get(), channel.c_str(), bytes.data(), static_cast<unsigned int>(bytes.size())) == 0;
}

bool LcmBus::can_carry(const std::string& channel, std::span<const std::byte> bytes) {
  return channel.size() <= LCM_MAX_CHANNEL_NAME_LENGTH && bytes.size() <= LCM_MAX_MESSAGE_SIZE;
}

}  // namespace graspd
