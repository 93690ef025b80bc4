# A cache before several replicas, with Varnish 6.6 or later: one request for many equal ones, 304 from the cache, answers that are a
# little old while no replica answers. Equal URLs go to the same replica.
# Start it with `varnishd -p timeout_idle=75 ...`: after the default of 5 s it closes connections that clients are about to use again.
vcl 4.1;

import directors;

probe ready {
  .url = "/readyz";
  .interval = 500ms;
  .timeout = 1s;
  .window = 3;
  .threshold = 2;
}

backend seedmesh_1 { .host = "seedmesh-1"; .port = "8080"; .probe = ready; .connect_timeout = 1s; .first_byte_timeout = 40s; }
backend seedmesh_2 { .host = "seedmesh-2"; .port = "8080"; .probe = ready; .connect_timeout = 1s; .first_byte_timeout = 40s; }
backend seedmesh_3 { .host = "seedmesh-3"; .port = "8080"; .probe = ready; .connect_timeout = 1s; .first_byte_timeout = 40s; }

sub vcl_init {
  new replicas = directors.shard();
  replicas.add_backend(seedmesh_1);
  replicas.add_backend(seedmesh_2);
  replicas.add_backend(seedmesh_3);
  replicas.reconfigure();
  new any = directors.round_robin();
  any.add_backend(seedmesh_1);
  any.add_backend(seedmesh_2);
  any.add_backend(seedmesh_3);
}

sub vcl_recv {
  set req.backend_hint = replicas.backend(by = URL);
  if (req.url == "/metrics") {
    return (synth(404));
  }
  if (req.method != "GET" && req.method != "HEAD") {
    set req.backend_hint = any.backend();
    return (pass);
  }
  # The service varies by Accept-Encoding itself; Varnish would ask for gzip alone.
  if (req.http.Authorization || req.http.X-Api-Key) {
    return (pass);
  }
  return (hash);
}

# A replica that does not answer costs another try at the next one by the same hash. What is posted is not repeated: its body is gone.
sub vcl_backend_fetch {
  if (bereq.retries > 0) {
    set bereq.backend = replicas.backend(by = URL, alt = bereq.retries);
  }
}

sub vcl_backend_error {
  if (bereq.retries < 2 && (bereq.method == "GET" || bereq.method == "HEAD")) {
    return (retry);
  }
}

sub vcl_backend_response {
  if (beresp.status == 503 && bereq.retries < 2 && (bereq.method == "GET" || bereq.method == "HEAD")) {
    return (retry);
  }
  # "no-cache" of the service means: ask again with the ETag.
  if (beresp.status == 200 && beresp.http.Cache-Control ~ "no-cache" && beresp.http.ETag) {
    set beresp.ttl = 1s;
    set beresp.grace = 10s;
    set beresp.keep = 7d;
    set beresp.uncacheable = false;
  }
  if (beresp.status >= 400) {
    set beresp.uncacheable = true;
    set beresp.ttl = 0s;
  }
}

sub vcl_deliver {
  if (obj.hits > 0) {
    set resp.http.X-Cache = "HIT";
  } else {
    set resp.http.X-Cache = "MISS";
  }
}
