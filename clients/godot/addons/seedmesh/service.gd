@tool
extends RefCounted
## Calls of the server that wait for the answer. An importer has no frames in which signals arrive.

const PATIENCE_MS := 60000


class Answer:
	var body := PackedByteArray()
	## Of the model, if it is one.
	var triangles := 0
	## One line for each error of a refusal, beginning with its pointer; or why there is no answer.
	var errors: PackedStringArray = []


static func get_json(target: String) -> Variant:
	var answer := _call(HTTPClient.METHOD_GET, target, "")
	for line in answer.errors:
		push_error(line)
	return JSON.parse_string(answer.body.get_string_from_utf8()) if answer.errors.is_empty() else null


static func get_bytes(target: String) -> Answer:
	return _call(HTTPClient.METHOD_GET, target, "")


static func post(target: String, request: Dictionary) -> Answer:
	return _call(HTTPClient.METHOD_POST, target, JSON.stringify(request))


static func _call(method: HTTPClient.Method, target: String, body: String) -> Answer:
	var end := Time.get_ticks_msec() + PATIENCE_MS
	while true:
		var answer := Answer.new()
		var wait := _call_once(method, target, body, end, answer)
		if wait < 0 or Time.get_ticks_msec() + wait > end:
			return answer
		OS.delay_msec(wait)
	return null


## Fills the answer. The result is the time in milliseconds after which the call is worth repeating, or -1.
static func _call_once(method: HTTPClient.Method, target: String, body: String, end: int, answer: Answer) -> int:
	var url: String = ProjectSettings.get_setting("seedmesh/server", "http://127.0.0.1:8080")
	var parts := RegEx.create_from_string("^(https?)://([^:/]+)(?::(\\d+))?/?$").search(url)
	if parts == null:
		answer.errors.append(": found %s as seedmesh/server, expected an address like http://127.0.0.1:8080" % url)
		return -1
	var is_tls := parts.get_string(1) == "https"
	var port := int(parts.get_string(3)) if parts.get_string(3) else (443 if is_tls else 80)
	var client := HTTPClient.new()
	client.connect_to_host(parts.get_string(2), port, TLSOptions.client() if is_tls else null)
	if not _wait(client, [HTTPClient.STATUS_RESOLVING, HTTPClient.STATUS_CONNECTING], end) or client.get_status() != HTTPClient.STATUS_CONNECTED:
		answer.errors.append(": no server at %s" % url)
		return -1
	var headers: PackedStringArray = ["Content-Type: application/json"] if body else []
	var key: String = ProjectSettings.get_setting("seedmesh/key", "")
	if key:
		headers.append("Authorization: Bearer " + key)
	client.request(method, target, headers, body)
	if not _wait(client, [HTTPClient.STATUS_REQUESTING], end) or not client.has_response():
		answer.errors.append(": the server at %s did not answer" % url)
		return -1
	while client.get_status() == HTTPClient.STATUS_BODY:
		client.poll()
		answer.body.append_array(client.read_response_body_chunk())
		if Time.get_ticks_msec() > end:
			answer.errors.append(": the answer of %s did not end in time" % url)
			return -1
	var status := client.get_response_code()
	var fields := {}
	for line in client.get_response_headers():
		fields[line.get_slice(":", 0).to_lower()] = line.get_slice(":", 1).strip_edges()
	answer.triangles = int(fields.get("seedmesh-triangles", "0"))
	if status == 200:
		return -1
	answer.errors = _errors_of(status, answer.body)
	if (status == 429 or status == 503) and fields.has("retry-after"):
		return maxi(int(fields["retry-after"]) * 1000, 100)
	return -1


static func _wait(client: HTTPClient, while_in: Array, end: int) -> bool:
	while client.get_status() in while_in:
		client.poll()
		if Time.get_ticks_msec() > end:
			return false
		OS.delay_msec(2)
	return true


static func _errors_of(status: int, body: PackedByteArray) -> PackedStringArray:
	var lines: PackedStringArray = []
	var problem: Variant = JSON.parse_string(body.get_string_from_utf8())
	if problem is Dictionary:
		for error in problem.get("errors", []):
			var position := ":%d:%d" % [error["line"], error["column"]] if error.has("line") else ""
			lines.append("%s%s: %s" % [error["pointer"], position, error["message"]])
		if lines.is_empty():
			lines.append(": %s" % problem.get("detail", problem.get("title", "")))
	else:
		lines.append(": HTTP status %d" % status)
	return lines
