#include "vigil/adapters/console/server.hpp"

#include <array>
#include <chrono>
#include <exception>
#include <random>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <fmt/format.h>

#include "vigil/adapters/console/desk_thread.hpp"
#include "vigil/adapters/console/http_wire.hpp"
#include "vigil/adapters/console/hub.hpp"
#include "vigil/adapters/console/outbound.hpp"
#include "vigil/adapters/console/replay_desk.hpp"
#include "vigil/adapters/console/replay_thread.hpp"
#include "vigil/adapters/console/rest.hpp"
#include "vigil/adapters/console/seats.hpp"

namespace vigil::console {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
namespace net = boost::asio;
using Tcp = net::ip::tcp;
using Error = boost::system::error_code;
using namespace std::chrono_literals;

using PlainStream = beast::tcp_stream;
using TlsStream = beast::ssl_stream<beast::tcp_stream>;
using Request = WireRequest;

constexpr auto kHttpTimeout = 30s;
constexpr auto kPollEvery = 5ms;
constexpr auto kOverEvery = 100ms;
constexpr int kSendBufferBytes =
    128 * 1024;  // what the kernel holds back of a client that does not confirm is old when it arrives

std::chrono::nanoseconds monotonic_now() { return std::chrono::steady_clock::now().time_since_epoch(); }

/// What a connection needs of the server; it outlives all of them.
struct Host {
  Hub& hub;
  Rest& rest;
  const Gate& gate;
  Seats& seats;
};

/// A WebSocket of one client. The sockets' thread only.
template <typename Stream>
class Talk final : public ClientLine, public Guest, public std::enable_shared_from_this<Talk<Stream>> {
 public:
  Talk(Stream stream, Host& host, std::string origin)
      : socket_(std::move(stream)), host_(host), origin_(std::move(origin)) {}

  void begin(const Request& request) {
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = 10s;
    timeout.idle_timeout = 30s;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      response.set(http::field::server, "vigil");
      response.set(http::field::sec_websocket_protocol, kProtocol);
    }));
    socket_.read_message_max(kMostMessageBytes);
    socket_.auto_fragment(false);
    beast::get_lowest_layer(socket_).expires_never();
    socket_.async_accept(request, [self = this->shared_from_this()](Error error) {
      if (!error) self->join();
    });
  }

  void say(SharedBytes text) override {
    if (is_closing_ || is_broken_) return;
    if (!outbound_.say(std::move(text))) return break_off();
    send_next();
  }

  void show(Latest kind, SharedBytes bytes) override {
    if (is_closing_ || is_broken_) return;
    outbound_.show(kind, std::move(bytes));
    send_next();
  }

  void close() override {
    is_closing_ = true;
    send_next();
  }

  void pace() override { outbound_.pace(); }

  [[nodiscard]] bool confirm(std::uint64_t received) override {
    const bool is_so = outbound_.confirm(received, monotonic_now());
    if (is_so) send_next();
    return is_so;
  }

  [[nodiscard]] const std::string& origin() const override { return origin_; }
  [[nodiscard]] bool is_stranger() const override { return !host_.hub.knows(client_); }
  void give_place() override { break_off(); }

 private:
  void join() {
    client_ = host_.hub.connect(this->shared_from_this());
    read_next();
  }

  void read_next() {
    socket_.async_read(received_, [self = this->shared_from_this()](Error error, std::size_t) {
      if (error || self->is_broken_) return self->leave();
      self->take();
    });
  }

  void take() {
    if (socket_.got_text()) {
      const auto bytes = received_.data();
      host_.hub.receive(client_, {static_cast<const char*>(bytes.data()), bytes.size()});
    } else {
      host_.hub.refuse_message(client_, "malformed", "messages are JSON text, not bytes");
    }
    received_.consume(received_.size());
    if (received_.capacity() > kKeptBuffer) received_.shrink_to_fit();
    read_next();
  }

  void leave() {
    is_broken_ = true;
    if (client_ != 0) host_.hub.disconnect(std::exchange(client_, 0));
  }

  /// One message at a time; what comes meanwhile waits in outbound_.
  void send_next() {
    if (is_sending_ || is_broken_) return;
    std::optional<Outbound::Message> message = outbound_.next(monotonic_now());
    if (!message) return is_closing_ ? say_goodbye() : void();
    is_sending_ = true;
    socket_.text(message->is_text);
    const SharedBytes bytes = message->bytes;
    socket_.async_write(net::buffer(*bytes), [self = this->shared_from_this(), bytes](Error error, std::size_t) {
      self->is_sending_ = false;
      if (error) return self->leave();
      self->send_next();
    });
  }

  void say_goodbye() {
    is_broken_ = true;
    socket_.async_close(websocket::close_code::normal, [self = this->shared_from_this()](Error) {});
  }

  /// No polite word: none would arrive, or there is no time for it.
  void break_off() {
    is_broken_ = true;
    beast::get_lowest_layer(socket_).close();
  }

  static constexpr std::size_t kKeptBuffer = 64 * 1024;

  websocket::stream<Stream> socket_;
  Host& host_;
  std::string origin_;
  beast::flat_buffer received_;
  Outbound outbound_;
  Hub::ClientId client_ = 0;
  bool is_sending_ = false;
  bool is_closing_ = false;
  bool is_broken_ = false;
};

/// A connection that speaks HTTP, until it ends or becomes a WebSocket. The sockets' thread only.
template <typename Stream>
class Visit final : public Guest, public std::enable_shared_from_this<Visit<Stream>> {
 public:
  Visit(Stream stream, Host& host, std::string origin)
      : stream_(std::move(stream)), host_(host), origin_(std::move(origin)) {}

  void begin() {
    if constexpr (std::is_same_v<Stream, TlsStream>) {
      beast::get_lowest_layer(stream_).expires_after(kHttpTimeout);
      stream_.async_handshake(net::ssl::stream_base::server, [self = this->shared_from_this()](Error error) {
        if (!error) self->read_next();
      });
    } else {
      read_next();
    }
  }

  [[nodiscard]] const std::string& origin() const override { return origin_; }
  [[nodiscard]] bool is_stranger() const override { return true; }
  void give_place() override { beast::get_lowest_layer(stream_).close(); }

 private:
  void read_next() {
    parser_.emplace();
    bound(*parser_);
    beast::get_lowest_layer(stream_).expires_after(kHttpTimeout);
    http::async_read(stream_, buffer_, *parser_, [self = this->shared_from_this()](Error error, std::size_t) {
      if (error == http::error::body_limit || error == http::error::header_limit) return self->send(too_large(), false);
      if (error) return self->finish();
      self->take();
    });
  }

  void take() {
    request_ = parser_->release();
    if (const auto refusal = request_refusal(request_)) return send(*refusal, false);
    if (websocket::is_upgrade(request_)) return upgrade();
    // The answer may come later, when the connection is gone; then nobody is told.
    host_.rest.answer(http_request(request_), [self = this->shared_from_this()](const HttpAnswer& answer) {
      self->send(answer, self->request_.keep_alive());
    });
  }

  void upgrade() {
    if (const auto refusal = upgrade_refusal(request_, host_.gate)) return send(*refusal, false);
    const auto talk = std::make_shared<Talk<Stream>>(std::move(stream_), host_, origin_);
    host_.seats.seat(talk);
    talk->begin(request_);
  }

  void send(const HttpAnswer& answer, bool goes_on) {
    response_ = wire_response(answer, request_);
    if (!goes_on) response_.keep_alive(false);
    beast::get_lowest_layer(stream_).expires_after(kHttpTimeout);
    http::async_write(stream_, response_, [self = this->shared_from_this(), goes_on](Error error, std::size_t) {
      if (error || !goes_on) return self->finish();
      self->read_next();
    });
  }

  void finish() {
    Error ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(Tcp::socket::shutdown_both, ignored);
  }

  Stream stream_;
  Host& host_;
  std::string origin_;
  beast::flat_buffer buffer_{kMostMessageBytes + kMostHeaderBytes};
  std::optional<WireParser> parser_;
  Request request_;
  WireResponse response_;
};

double wall_ms_now() {
  return std::chrono::duration<double, std::milli>(std::chrono::system_clock::now().time_since_epoch()).count();
}

Tcp::endpoint endpoint_of(const ServerOptions& options) {
  Error error;
  const auto address = net::ip::make_address(options.address == "localhost" ? "127.0.0.1" : options.address, error);
  if (error)
    throw SetupError(
        fmt::format("--address {}: is no address; give for example 127.0.0.1, or 0.0.0.0 for all of this "
                    "machine's",
                    options.address));
  return {address, options.port};
}

std::optional<net::ssl::context> tls_of(const ServerOptions& options) {
  if (options.certificate.empty()) return std::nullopt;
  net::ssl::context context(net::ssl::context::tls_server);
  context.set_options(net::ssl::context::default_workarounds | net::ssl::context::no_tlsv1 |
                      net::ssl::context::no_tlsv1_1 | net::ssl::context::single_dh_use);
  Error error;
  context.use_certificate_chain_file(options.certificate.string(), error);
  if (error)
    throw SetupError(fmt::format("--certificate {}: cannot be used ({}); give a PEM file of the chain",
                                 options.certificate.string(), error.message()));
  context.use_private_key_file(options.key.string(), net::ssl::context::pem, error);
  if (error)
    throw SetupError(fmt::format("--key {}: cannot be used ({}); give the certificate's PEM key", options.key.string(),
                                 error.message()));
  return context;
}

/// Whoever looked at an earlier run of the program must not take this one for it: chance, not a counter.
std::string name_of_a_run() {
  std::random_device chance;
  return fmt::format("{:08x}{:08x}", chance(), chance());
}

}  // namespace

class Server::Sockets {
 public:
  Sockets(const ServerOptions& options, Desk::MakeFlight make_flight, std::shared_ptr<runtime::FlightStore> store)
      : page_(options.page),
        gate_(options.address, options.names),
        tls_(tls_of(options)),
        hub_({options.program, options.tokens, options.recording_folder, name_of_a_run()},
             {monotonic_now, wall_ms_now,
              [this](std::function<void(Desk&)> task) { return desk_thread_ && desk_thread_->post(std::move(task)); },
              [this](const WhyQuestion& question) { return replay_desk_ != nullptr && replay_desk_->ask(question); }}),
        rest_(hub_, gate_, page_),
        desk_(
            std::move(make_flight), [this](DeskNews news) { tell_hub(std::move(news)); }, std::move(store)),
        overhear_(options.overhear),
        ready_(options.ready),
        address_(options.address) {
    listen(endpoint_of(options));
  }

  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  [[nodiscard]] std::string url() const {
    const bool is_v6 = address_.find(':') != std::string::npos;
    return fmt::format("{}://{}{}{}:{}/", tls_ ? "https" : "http", is_v6 ? "[" : "", address_, is_v6 ? "]" : "",
                       port());
  }

  void run(const runtime::Mission& mission, const runtime::SavedFlight* saved, const std::function<bool()>& is_over) {
    desk_.begin(mission, saved);  // before its thread is there: what it throws is the caller's
    desk_thread_.emplace(desk_, [this](std::string text) { tell_hub(DeskTrouble{std::move(text)}); });
    serve_until(is_over);
    desk_thread_.reset();
    desk_.end();
  }

  void show(const std::shared_ptr<runtime::ReplayLoop>& recording, const std::function<bool()>& is_over) {
    ReplayDesk desk(recording, [this](DeskNews news) { tell_hub(std::move(news)); });
    desk.begin();
    replay_desk_ = &desk;
    const ReplayThread thread(desk, [this](const std::string& text) { tell_hub(DeskTrouble{text}); });
    serve_until(is_over);
    replay_desk_ = nullptr;
  }

  void command(ClientMessage message, Role role, std::string by, std::function<void(const std::string&)> answer) {
    net::post(context_, [this, message = std::move(message), role, by = std::move(by), answer = std::move(answer)] {
      hub_.command(message, role, by, [answer](const Json& reply) {
        answer(reply.at("type") == "refused" ? reply.at("reason").get<std::string>() : std::string());
      });
    });
  }

  void warn(std::string text) { tell_hub(DeskTrouble{std::move(text)}); }

 private:
  void serve_until(const std::function<bool()>& is_over) {
    accept_next();
    poll();
    ask_whether(is_over);
    context_.run();
  }

  void listen(const Tcp::endpoint& endpoint) {
    Error error;
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
    if (error)
      throw SetupError(fmt::format("{}:{}: cannot listen there ({}); choose another --port, or --port 0 for a free one",
                                   endpoint.address().to_string(), endpoint.port(), error.message()));
  }

  void accept_next() {
    acceptor_.async_accept([this](Error error, Tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (!error && seats_.make_room()) welcome(std::move(socket));
      if (error) return wait_to_accept();
      accept_next();
    });
  }

  /// Out of file descriptors, say: what comes waits in the kernel's queue.
  void wait_to_accept() {
    accept_timer_.expires_after(100ms);
    accept_timer_.async_wait([this](Error error) {
      if (!error) accept_next();
    });
  }

  void welcome(Tcp::socket socket) {
    Error ignored;
    socket.set_option(Tcp::no_delay(true), ignored);
    socket.set_option(net::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    const Tcp::endpoint from = socket.remote_endpoint(ignored);
    const std::string origin = from.address().to_string();
    if (tls_)
      receive(std::make_shared<Visit<TlsStream>>(TlsStream(std::move(socket), *tls_), host_, origin));
    else
      receive(std::make_shared<Visit<PlainStream>>(PlainStream(std::move(socket)), host_, origin));
  }

  template <typename Stream>
  void receive(const std::shared_ptr<Visit<Stream>>& visit) {
    seats_.seat(visit);
    visit->begin();
  }

  void tell_hub(DeskNews news) {
    if (overhear_) overhear_(news);
    net::post(context_, [this, news = std::make_shared<DeskNews>(std::move(news))] { hub_.take(std::move(*news)); });
  }

  void poll() {
    hub_.poll();
    if (ready_ && hub_.has_ticked()) std::exchange(ready_, nullptr)();
    poll_timer_.expires_after(kPollEvery);
    poll_timer_.async_wait([this](Error error) {
      if (!error) poll();
    });
  }

  void ask_whether(const std::function<bool()>& is_over) {
    if (is_over()) return end();
    over_timer_.expires_after(kOverEvery);
    over_timer_.async_wait([this, is_over](Error error) {
      if (!error) ask_whether(is_over);
    });
  }

  /// Says goodbye, gives that a moment, and stops.
  void end() {
    Error ignored;
    acceptor_.close(ignored);
    poll_timer_.cancel();
    hub_.end();
    over_timer_.expires_after(kOverEvery);
    over_timer_.async_wait([this](Error) { context_.stop(); });
  }

  Page page_;
  Gate gate_;
  std::optional<net::ssl::context> tls_;
  Seats seats_{kMostConnections};  // outlives the connections, which the context keeps
  net::io_context context_{1};
  Tcp::acceptor acceptor_{context_};
  net::steady_timer accept_timer_{context_};
  net::steady_timer poll_timer_{context_};
  net::steady_timer over_timer_{context_};
  Hub hub_;
  Rest rest_;
  Host host_{hub_, rest_, gate_, seats_};
  Desk desk_;
  std::optional<DeskThread> desk_thread_;
  ReplayDesk* replay_desk_ = nullptr;  ///< during show()
  std::function<void(const DeskNews&)> overhear_;
  std::function<void()> ready_;  ///< until it was called
  std::string address_;
};

Server::Server(const ServerOptions& options, Desk::MakeFlight make_flight, std::shared_ptr<runtime::FlightStore> store)
    : sockets_(std::make_unique<Sockets>(options, std::move(make_flight), std::move(store))) {}

Server::~Server() = default;

std::uint16_t Server::port() const { return sockets_->port(); }

std::string Server::url() const { return sockets_->url(); }

void Server::run(const runtime::Mission& mission, const runtime::SavedFlight* saved,
                 const std::function<bool()>& is_over) {
  sockets_->run(mission, saved, is_over);
}

void Server::show(const std::shared_ptr<runtime::ReplayLoop>& recording, const std::function<bool()>& is_over) {
  sockets_->show(recording, is_over);
}

void Server::command(ClientMessage message, Role role, std::string by,
                     std::function<void(const std::string& refusal)> answer) {
  sockets_->command(std::move(message), role, std::move(by), std::move(answer));
}

void Server::warn(std::string text) { sockets_->warn(std::move(text)); }

}  // namespace vigil::console
