// SPDX-License-Identifier: Apache-2.0
#include "sil/view/web/view_server.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <utility>

#include "sil/view/web/viewer.hpp"

namespace striker::sil {

namespace asio = boost::asio;

namespace {

using Error = boost::system::error_code;

constexpr std::chrono::milliseconds state_period{33};
constexpr std::chrono::milliseconds accept_pause{100};
constexpr std::chrono::milliseconds most_good_bye{1000};
constexpr std::chrono::milliseconds good_bye_step{10};
constexpr int niceness = 5;  // where processors are short, the run goes first

asio::ip::address address_of(const std::string& text) {
  Error error;
  auto address = asio::ip::make_address(text, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("--view-bind {}: not an address: give one of this machine, as 127.0.0.1", text));
  }
  return address;
}

std::string in_url(const asio::ip::address& address) {
  return address.is_v6() ? fmt::format("[{}]", address.to_string()) : address.to_string();
}

// Signals are the run's: they end its waits.
template <class Body>
std::thread without_signals(Body body) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::move(body));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

class ViewServer::Impl {
 public:
  Impl(const ViewServerPlan& plan, ViewExchange& exchange)
      : hall_{.exchange = exchange, .rules = {}, .hello = hello_text(plan.facts)} {
    listen(plan);
    accept();
    ask();
    thread_ = without_signals([this] {
      setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
      serve();
    });
  }
  ~Impl() { finish("it failed; what it said last is on its terminal"); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] const std::string& url() const { return url_; }

  void finish(const std::string& why) {
    if (thread_.joinable()) {
      asio::post(context_, [this, why] { end(why); });
      thread_.join();
    }
  }

 private:
  void listen(const ViewServerPlan& plan) {
    const asio::ip::tcp::endpoint wanted(address_of(plan.address), plan.port);
    try {
      acceptor_.open(wanted.protocol());
      acceptor_.set_option(asio::socket_base::reuse_address(true));
      acceptor_.bind(wanted);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw std::runtime_error(
          fmt::format("--view {}: cannot listen on {} ({}): give another port, or none for any that is free",
                      plan.port, plan.address, error.code().message()));
    }
    hall_.rules = {.token = draw_token(),
                   .address = in_url(wanted.address()),
                   .port = acceptor_.local_endpoint().port()};
    url_ = fmt::format("http://{}:{}/?token={}", shown_address(wanted.address()), hall_.rules.port,
                       hall_.rules.token);
  }

  // To be opened on this machine.
  static std::string shown_address(const asio::ip::address& address) {
    return address.is_unspecified() ? (address.is_v6() ? "[::1]" : "127.0.0.1") : in_url(address);
  }

  // Whatever goes wrong here, the run goes on.
  void serve() {
    for (bool again = true; again;) {
      try {
        context_.run();
        again = false;
      } catch (const std::exception& error) {
        fmt::print(stderr, "striker-sil: live view: {}\n", error.what());
      }
    }
  }

  void accept() {
    acceptor_.async_accept([this](Error error, asio::ip::tcp::socket socket) {
      if (hall_.ended) {
        return;
      }
      if (error) {  // as where the process has no more descriptors
        accept_timer_.expires_after(accept_pause);
        accept_timer_.async_wait([this](Error) { accept(); });
        return;
      }
      if (hall_.connections < ViewHall::most_connections) {
        std::make_shared<Viewer>(std::move(socket), hall_)->begin();
      }
      accept();
    });
  }

  // The run answers after its next tick: what it answered to the question before is shown now.
  void ask() {
    timer_.expires_after(state_period);
    timer_.async_wait([this](Error) {
      if (hall_.ended) {
        return;
      }
      show_latest();
      hall_.exchange.wanted.store(!hall_.viewers.empty(), std::memory_order_relaxed);
      ask();
    });
  }

  void show_latest() {
    const LiveState* fresh = hall_.exchange.states.take();
    if (fresh == nullptr || hall_.viewers.empty()) {
      return;
    }
    const auto text = std::make_shared<const std::string>(state_text(*fresh));
    for (Viewer* viewer : hall_.viewers) {
      viewer->show(text);
    }
  }

  void end(const std::string& why) {
    show_latest();
    hall_.ended = true;
    Error ignored;
    acceptor_.close(ignored);
    const auto text = std::make_shared<const std::string>(ended_text(why));
    const auto viewers = hall_.viewers;
    for (Viewer* viewer : viewers) {
      viewer->end(text);
    }
    say_good_bye(most_good_bye);
  }

  void say_good_bye(std::chrono::milliseconds left) {
    if (hall_.viewers.empty() || left.count() <= 0) {
      context_.stop();
      return;
    }
    timer_.expires_after(good_bye_step);
    timer_.async_wait([this, left](Error) { say_good_bye(left - good_bye_step); });
  }

  // Connections live as operations of the context, and know the hall: it goes last.
  ViewHall hall_;
  asio::io_context context_{1};
  asio::ip::tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_};
  asio::steady_timer accept_timer_{context_};
  std::string url_;
  std::thread thread_;
};

ViewServer::ViewServer(const ViewServerPlan& plan, ViewExchange& exchange)
    : impl_(std::make_unique<Impl>(plan, exchange)) {}

ViewServer::~ViewServer() = default;

const std::string& ViewServer::url() const {
  return impl_->url();
}

void ViewServer::finish(const std::string& why) {
  impl_->finish(why);
}

}  // namespace striker::sil
