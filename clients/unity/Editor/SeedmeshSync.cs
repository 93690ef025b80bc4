using System.Collections.Generic;
using System.IO;
using System.Net;
using System.Net.Http;
using System.Net.Http.Headers;
using System.Security.Cryptography;
using System.Text;
using UnityEditor;
using UnityEngine;

namespace Seedmesh.Editor
{
    /// <summary>
    /// Makes the GLB file, or the prefab of a scene, beside each request file that changed. An importer of Unity has to give the same result on every machine,
    /// so requests are sent by this menu and by the command line, never during an import:
    ///   Unity -batchmode -quit -projectPath . -executeMethod Seedmesh.Editor.SeedmeshSync.FromCommandLine
    /// </summary>
    public static class SeedmeshSync
    {
        const string UrlKey = "Seedmesh.Url";
        const string DefaultUrl = "http://127.0.0.1:8080";
        static readonly HttpClient Client = new HttpClient();

        public static string Url
        {
            get => System.Environment.GetEnvironmentVariable("SEEDMESH_URL") ?? EditorPrefs.GetString(UrlKey, DefaultUrl);
            set => EditorPrefs.SetString(UrlKey, value);
        }

        [MenuItem("Assets/Seedmesh/Make changed models")]
        public static void FromMenu() => Sync();

        public static void FromCommandLine() => EditorApplication.Exit(Sync() ? 0 : 1);

        /// <summary>True if every request file has its model.</summary>
        public static bool Sync()
        {
            var is_complete = true;
            foreach (var path in Directory.EnumerateFiles("Assets", "*.seedmesh", SearchOption.AllDirectories))
            {
                var text = File.ReadAllText(path, Encoding.UTF8);
                if (IsCurrent(path, text)) continue;
                if (!Make(path, text, ModelOf(path, text))) { is_complete = false; continue; }
                File.WriteAllText(HashFile(path), Digest(text));
                AssetDatabase.ImportAsset(path); // takes back the warning of its importer
            }
            AssetDatabase.Refresh();
            return is_complete;
        }

        /// <summary>True if the model of a request file is there and was made from this text.</summary>
        public static bool IsCurrent(string path, string text) =>
            File.Exists(ModelOf(path, text)) && File.Exists(HashFile(path)) && File.ReadAllText(HashFile(path)) == Digest(text);

        static string HashFile(string path) => path + ".sha256";

        static string ModelOf(string path, string text) => Path.ChangeExtension(path, SeedmeshPlacements.IsWanted(text) ? ".prefab" : ".glb");

        static bool Make(string path, string text, string model)
        {
            try
            {
                using (var request = RequestOf(text))
                using (var answer = Client.SendAsync(request).GetAwaiter().GetResult())
                {
                    var body = answer.Content.ReadAsByteArrayAsync().GetAwaiter().GetResult();
                    if (answer.StatusCode != HttpStatusCode.OK)
                    {
                        Debug.LogError($"{path}: {Explained(Encoding.UTF8.GetString(body))}");
                        return false;
                    }
                    if (SeedmeshPlacements.IsWanted(text))
                    {
                        SeedmeshPlacements.Make(path, body);
                        return true;
                    }
                    File.WriteAllBytes(model + ".part", body);
                    if (File.Exists(model)) File.Delete(model);
                    File.Move(model + ".part", model);
                    return true;
                }
            }
            catch (HttpRequestException error)
            {
                Debug.LogError($"{path}: no server at {Url}: {error.Message}");
                return false;
            }
        }

        static HttpRequestMessage RequestOf(string text)
        {
            var request = new HttpRequestMessage(HttpMethod.Post, Url.TrimEnd('/') + "/v1/generate");
            request.Content = new StringContent(text, Encoding.UTF8, "application/json");
            var key = System.Environment.GetEnvironmentVariable("SEEDMESH_KEY");
            if (!string.IsNullOrEmpty(key)) request.Headers.Authorization = new AuthenticationHeaderValue("Bearer", key);
            return request;
        }

        [System.Serializable] class Problem { public string title = ""; public string detail = ""; public List<Entry> errors = new List<Entry>(); }
        [System.Serializable] class Entry { public string pointer = ""; public string message = ""; }

        static string Explained(string body)
        {
            try
            {
                var problem = JsonUtility.FromJson<Problem>(body);
                if (problem.errors.Count == 0) return problem.detail.Length > 0 ? problem.detail : problem.title;
                return string.Join("\n", problem.errors.ConvertAll(each => $"{each.pointer}: {each.message}"));
            }
            catch (System.ArgumentException) { return body; }
        }

        static string Digest(string text)
        {
            using (var sha = SHA256.Create())
            {
                return System.BitConverter.ToString(sha.ComputeHash(Encoding.UTF8.GetBytes(text))).Replace("-", "").ToLowerInvariant();
            }
        }
    }
}
