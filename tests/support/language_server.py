"""Drives yaml-language-server, as editors do: JSON-RPC over its standard input and output."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from support.toolchains import language_server

_SETTINGS = {
    "yaml": {"schemaStore": {"enable": False}, "validate": True, "hover": True, "completion": True},
    "http": {},
}


class LanguageServer:
    """A server with one folder open."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.last = 0
        self.diagnostics: dict[str, list[dict[str, Any]]] = {}

    def __enter__(self) -> Self:
        self.process = subprocess.Popen(
            language_server(), stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=self.folder
        )
        folders = [{"uri": self.folder.as_uri(), "name": "descriptions"}]
        text = {
            "completion": {"completionItem": {"documentationFormat": ["markdown"], "snippetSupport": False}},
            "hover": {"contentFormat": ["markdown"]},
            "publishDiagnostics": {},
        }
        capabilities = {"textDocument": text, "workspace": {"configuration": True, "workspaceFolders": True}}
        self.ask("initialize", processId=None, rootUri=None, capabilities=capabilities, workspaceFolders=folders)
        self.tell("initialized")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.process.kill()
        self.process.communicate()

    def open(self, name: str, text: str) -> None:
        """Open a file of the folder with this text."""
        uri = (self.folder / name).as_uri()
        self.tell("textDocument/didOpen", textDocument={"uri": uri, "languageId": "yaml", "version": 1, "text": text})

    def findings(self, name: str) -> list[dict[str, Any]]:
        """What the server finds wrong with a file that was opened."""
        uri = (self.folder / name).as_uri()
        while uri not in self.diagnostics:
            self._take(self._read())
        return self.diagnostics.pop(uri)

    def hover(self, name: str, line: int, column: int) -> str:
        """What an editor shows of the word there (line and column from 0)."""
        answer = self._at("hover", name, line, column)
        return str(answer["contents"]["value"]) if answer else ""

    def completions(self, name: str, line: int, column: int) -> dict[str, dict[str, Any]]:
        """What an editor offers there (line and column from 0), by its label."""
        answer = self._at("completion", name, line, column)
        items = answer["items"] if isinstance(answer, dict) else answer
        return {item["label"]: item for item in items}

    def _at(self, what: str, name: str, line: int, column: int) -> Any:
        document = {"uri": (self.folder / name).as_uri()}
        return self.ask(f"textDocument/{what}", textDocument=document, position={"line": line, "character": column})

    def ask(self, method: str, **params: Any) -> Any:
        """Send a request; its result."""
        self.last += 1
        number = self.last
        self._send(id=number, method=method, params=params)
        while True:
            message = self._read()
            if message.get("id") == number and "method" not in message:
                assert "error" not in message, message
                return message["result"]
            self._take(message)

    def tell(self, method: str, **params: Any) -> None:
        """Send a notification."""
        self._send(method=method, params=params)

    def _take(self, message: dict[str, Any]) -> None:
        """Answer what the server asks, and keep what it finds."""
        method, params = message.get("method"), message.get("params", {})
        if method == "textDocument/publishDiagnostics":
            self.diagnostics[params["uri"]] = params["diagnostics"]
        elif method == "workspace/configuration":
            self._send(id=message["id"], result=[_SETTINGS.get(item["section"]) for item in params["items"]])
        elif "id" in message:
            self._send(id=message["id"], result=None)

    def _send(self, **message: Any) -> None:
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        assert self.process.stdin is not None
        self.process.stdin.write(f"Content-Length: {len(data)}\r\n\r\n".encode() + data)
        self.process.stdin.flush()

    def _read(self) -> dict[str, Any]:
        stream = self.process.stdout
        assert stream is not None
        length = 0
        while (line := stream.readline().strip()) != b"":
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        assert length, "the server ended"
        message: dict[str, Any] = json.loads(stream.read(length))
        return message
